/* Ranges of fields as tables: tries what lies inside and outside of each. */
#ifndef PBMPM_TESTS_API_RULES_H
#define PBMPM_TESTS_API_RULES_H

#include "calls.h"

/** The world that the tests of a program abuse, and its state before. Set anew for each test. */
extern target good;
extern snapshot before;

void rules_set_up(void);

typedef enum value_type { FLOAT32, FLOAT64, INT32, UINT32 } value_type;

/** A number field and its range. An open end is itself refused; an end of INFINITY is not tried. */
typedef struct rule {
    const char *name;
    size_t offset;
    value_type type;
    double low, high;
    bool low_open, high_open;
} rule;

/** How a structure is used: `structure` is a copy of a good one with one field changed. */
typedef pbmpm_result use(const void *structure);

/** Tries NaN, the infinities, the ends of the range and what lies just outside, on every field of the table. What is
 *  refused must leave the world as it was. */
void check_rules(const rule *rules, size_t count, const void *sound, size_t size, use *apply);
#define CHECK_RULES(rules, sound, apply) check_rules(rules, sizeof(rules) / sizeof *(rules), &(sound), sizeof(sound), apply)
#define FIELD(structure, member) #structure "." #member, offsetof(structure, member)

#endif
