/* A robot file that is being read.
 */
#ifndef OSIRIS_ROBOT_TEXT_PARTS_H
#define OSIRIS_ROBOT_TEXT_PARTS_H

#include "attribute.h"
#include "iris/osiris/plan.h"

typedef struct {
    osiris_reader reader;
    osiris_plan *plan;
    osiris_device *devices;
    int32_t capacity;
    int has;     /* which lines have been there */
    int implied; /* the driver is nobody's line */
} osiris_robot_reading;

/* The line of the drive behind its first word, and that of a device from its first word on: one device more. There is room
 * for one. 0 when reader.expected says what is wrong. */
int osiris_robot_take_drive(osiris_robot_reading *reading);
int osiris_robot_take_device(osiris_robot_reading *reading);

#endif
