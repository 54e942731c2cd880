/* When which signals came to a team's robots, and what these did: a picture with a row for each robot, a text with a
 * line for each signal, or JSON.
 */
#ifndef IRIS_TOOL_TEAM_TIMELINE_H
#define IRIS_TOOL_TEAM_TIMELINE_H

#include "json.h"
#include "team_record.h"

/* Writes the picture, the text, or with the extension .json JSON. Complains; 1 when done, else 0. */
int team_timeline_write(const char *path, const team_record *record);

/* An array: at_s, unit, ref (of the robot), signal, from (the line of the group that it comes from, 0: its own), from_unit,
 * and x_mm, y_mm of its target where it has one. */
void team_signals_json(json_writer *json, const team_record *record);

#endif
