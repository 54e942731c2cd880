#include "words.h"

#include "iris/borg/chunk.h"
#include "lexer.h"

static const char *const signals[BORG_SIGNAL_KINDS] = {
    "START",     "OBJ_DETECT_TRUE", "OBJ_DETECT_FALSE", "TIME_OUT", "REACHED",    "VOTE_WIN",
    "VOTE_LOST", "STOPPED",         "LINE_END",         "BUMPED",   "BATTERY_LOW"};

static const char *const verbs[BORG_VERBS] = {"LineFollow", "ObjDetect", "AutoExplore", "MapBuild",
                                              "Go",         "Go",        "Turn",        "Stop",
                                              "ResetTime",  "Multicast"};

static const struct {
    const char *name;
    uint8_t kind;
} predicates[] = {{"ObjDetect", BORG_OBJ_DETECT_TRUE},
                  {"TimeOut", BORG_TIME_OUT},
                  {"Reached", BORG_REACHED},
                  {"LineEnd", BORG_LINE_END},
                  {"Bumped", BORG_BUMPED},
                  {"BatteryLow", BORG_BATTERY_LOW}},
  also_read[] = {{"OBJ_DET_TRUE", BORG_OBJ_DETECT_TRUE},
                 {"OBJ_DET_FALSE", BORG_OBJ_DETECT_FALSE},
                 {"TIME_OUT_TRUE", BORG_TIME_OUT}};

static const char *const keywords[] = {"START", "END", "UNITS", "TIMEOUT", "IF",   "ELSE",  "WHILE", "REF",
                                       "OF",    "AND", "OR",    "NOT",     "TRUE", "FALSE", "Target"};

static int32_t find(const char *const *names, int32_t count, const char *name, size_t length)
{
    for (int32_t i = 0; i < count; i++) {
        if (borg_same_word(name, length, names[i])) {
            return i;
        }
    }
    return -1;
}

const char *borg_signal_name(int32_t kind)
{
    return kind >= 0 && kind < BORG_SIGNAL_KINDS ? signals[kind] : NULL;
}

int32_t borg_signal_find(const char *name, size_t length)
{
    int32_t kind = name ? find(signals, BORG_SIGNAL_KINDS, name, length) : -1;
    for (size_t i = 0; name && kind < 0 && i < sizeof also_read / sizeof also_read[0]; i++) {
        kind = borg_same_word(name, length, also_read[i].name) ? also_read[i].kind : -1;
    }
    return kind;
}

const char *borg_verb_name(int32_t verb)
{
    return verbs[verb];
}

int32_t borg_verb_find(const char *name, size_t length)
{
    return find(verbs, BORG_VERBS, name, length);
}

int32_t borg_predicate_find(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof predicates / sizeof predicates[0]; i++) {
        if (borg_same_word(name, length, predicates[i].name)) {
            return predicates[i].kind;
        }
    }
    return -1;
}

const char *borg_word_written(const char *name, size_t length)
{
    const int32_t keyword = find(keywords, sizeof keywords / sizeof keywords[0], name, length);
    if (keyword >= 0) {
        return keywords[keyword];
    }
    const int32_t verb = borg_verb_find(name, length);
    if (verb >= 0) {
        return verbs[verb];
    }
    for (size_t i = 0; i < sizeof predicates / sizeof predicates[0]; i++) {
        if (borg_same_word(name, length, predicates[i].name)) {
            return predicates[i].name;
        }
    }
    return NULL;
}
