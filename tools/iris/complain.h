/* What goes wrong, in one line on standard error: iris <command>: <subject>: <what is wrong>. */
#ifndef IRIS_TOOL_COMPLAIN_H
#define IRIS_TOOL_COMPLAIN_H

/* Exit codes of every command. */
enum {
    EXIT_DONE = 0,
    EXIT_BAD_DATA = 1, /* the data or a device is bad */
    EXIT_BAD_CALL = 2  /* the call is wrong */
};

/* The command that complains from now on; null before one is known. */
void complain_as(const char *command);

/* From now on complaints go there, not to standard error; text has no line break at its end. Null: as before. */
void complain_to(void (*taker)(const char *subject, const char *text));

/* subject: a file or an option; null for none. */
void complain(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
