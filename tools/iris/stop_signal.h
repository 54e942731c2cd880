/* Ctrl-C and other ways to ask a program to end: a loop that looks here ends cleanly. A second one ends the program. */
#ifndef IRIS_TOOL_STOP_SIGNAL_H
#define IRIS_TOOL_STOP_SIGNAL_H

/* From now on. Signals that somebody caught or ignored before stay so. */
void stop_signal_catch(void);

int stop_signal_came(void);

#endif
