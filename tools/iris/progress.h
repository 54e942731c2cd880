/* A line that says how far long work is: on a terminal only, and only when nothing else is printed there. */
#ifndef IRIS_TOOL_PROGRESS_H
#define IRIS_TOOL_PROGRESS_H

/* Shows "<command> 3/120 name", at most ten times a second. Nothing is shown for a single part;
 * 0 parts: nobody knows how many there are. */
void progress_show(const char *command, int part, int parts, const char *name);

/* Takes the line away: before anything else is printed, and at the end. */
void progress_clear(void);

#endif
