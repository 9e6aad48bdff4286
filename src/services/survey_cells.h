/* The cells that matter lies in, what is in each, and which of them are one body: what a survey looks at. */
#ifndef PBMPM_SRC_SERVICES_SURVEY_CELLS_H
#define PBMPM_SRC_SERVICES_SURVEY_CELLS_H

#include "world/world.h"

/* What a group of matter has in one cell. Liquids are one group, each solid is its own. */
typedef struct Share {
    uint64_t place;   /* group, then two axes, then the axis that runs go along */
    int32_t cell[3];  /* from the first particle's, plus HALF */
    uint32_t group;
    uint32_t slot;    /* a material of the group */
    double filling;   /* rest volume over cell volume */
    double falling;   /* the same times its speed along gravity [m^2/s^3] */
    double thickness; /* least so far */
    double spacing;   /* [cells] of its particles at rest, the widest */
    float low[3], high[3]; /* [cells] where its first and its last particle lie in the cell, along each axis */
    uint32_t body;    /* an earlier share of the same body, or itself */
    bool held;        /* an obstacle is where it ends, or other matter below */
    bool borne;       /* of a body's first share: something below bears the body */
    bool lies;        /* of a body's first share: the body lies on an obstacle */
} Share;

/* Of places; and how many places of a kind a survey looks at, about. */
enum { AXIS_BITS = 18, GROUP_BITS = 9, HALF = 1 << (AXIS_BITS - 1), LOOKED_AT = 64 };

typedef struct Cells {
    Share *share;
    uint32_t count;
    int dimension;
} Cells;

/* What of matter is in a cell, seen from a body. */
typedef enum Below { NOTHING, ITSELF, OTHER } Below;

/* Names a group in a cell. `grouped`: by group first, and along `last` last; else by cell first, as lookups need it. */
uint64_t survey_place_of(const Share *share, int last, bool grouped);

/* By these names. "Sorted by cell": along 0, not grouped. */
void survey_sort_along(Cells *cells, int axis, bool grouped);

/* The cell that a particle is in, and whether it is near enough to the first's. */
bool survey_near_first(const Particles *p, uint32_t row, int32_t cell[3]);

/* One share per cell and group. Particles that are 2^18 cells from the first are left out. Most of those in a cell are stored together: few are left to sort. */
void survey_find_cells(const World *world, Cells *cells);

/* How many cells of a group lie one behind the other. Sorted along an axis, grouped. */
uint32_t survey_run_from(const Cells *cells, uint32_t first);

/* Of a cell [m]. */
double survey_middle_of(const World *world, const Share *share, int axis);

/* Cells from the middle of a cell to the first obstacle, or infinitely many if there is none within `far`. `along`: of length 1. */
double survey_cells_to_obstacle(const World *world, const Share *share, const double along[3], double far);

/* The first share at a place or behind it. Sorted by cell. */
uint32_t survey_first_from(const Cells *cells, uint64_t place);

/* The filling of all groups in a cell, 0 if there is none. Sorted by cell. */
double survey_filling_at(const Cells *cells, const int32_t cell[3]);

/* The share at a place; `count` if there is none. Sorted by cell. */
uint32_t survey_find_share(const Cells *cells, uint64_t place);

/* The first share of the same body. Bodies are found. */
uint32_t survey_body_of(Cells *cells, uint32_t i);

/* Joins cells of a solid that share a face, in 2D an edge, unless two spacings of particles lie between what is in them. Sorted by cell. */
void survey_find_bodies(Cells *cells);

/* Whether any of a group is in a cell. Sorted by cell. */
bool survey_any_of_group(const Cells *cells, const int32_t cell[3], uint32_t group);

/* A body's own before others'. Sorted by cell, bodies are found. */
Below survey_below_of(Cells *cells, const int32_t cell[3], uint32_t body);

/* Whether the next cell has none of its group: of all bodies of a material. Sorted by cell. */
bool survey_group_ends(const Cells *cells, const Share *share, int axis, int way);

#endif
