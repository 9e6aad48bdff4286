/* What walls_find() lists and walls_apply() goes through; see walls.h. */
#ifndef PBMPM_SRC_CONTACT_WALLS_LIST_H
#define PBMPM_SRC_CONTACT_WALLS_LIST_H

#include <stdbool.h>
#include <stdint.h>

enum { CORNERS_MAX = 8, NORMALS_MAX = 3 };
enum { VECTORS = 3 }; /* of four floats per node in Walls.vector; behind them one per entry */

/* Four floats that the CPU works on at once: a vector and one more, which means nothing. */
typedef float Four __attribute__((vector_size(16)));

typedef struct Columns {
    Four column[3];
} Columns;

/* What a node takes from others: A u~ of a place between them. */
typedef struct WallEntry {
    uint32_t parent[CORNERS_MAX]; /* nodes of the list */
    float weight[CORNERS_MAX];
    Columns matrix; /* A */
    uint32_t corners; /* parents */
    uint32_t follower;
    bool mirrored; /* for the density; else for the motion */
} WallEntry;

typedef struct WallNode {
    uint32_t node; /* of the grid */
    uint32_t entry_begin, entry_moving, entry_end; /* those from entry_moving on are for the density alone */
    uint32_t link_begin, link_moving, link_end; /* those from link_moving on are for the density alone */
    float mass;
    float own[6];      /* what of u~ it has itself: a symmetric matrix, the upper triangle row by row */
    float lump[6];     /* M, likewise */
    float shift[3];    /* c0 */
    float own_mirror;  /* share of the density that it keeps */
    float open;        /* share of its weight that is open; negative: not known */
    float normal[NORMALS_MAX][3];
    uint16_t obstacle[NORMALS_MAX];
    uint16_t normals;
    bool follows;      /* its motion is that of others, but for what `own` leaves it */
    float coefficient; /* of friction, on the nearest wall */
    float surface[3];  /* that wall's motion */
} WallNode;

/* Of a WallNode what each walls_apply() needs. */
typedef struct WallMotion {
    uint32_t node, entry_begin, entry_moving, link_begin, link_moving;
    float mass;
    Four shift; /* c0 */
} WallMotion;

typedef struct WallMatrices {
    Columns own, inverse; /* inverse: M^-1 */
} WallMatrices;

typedef struct WallLink {
    uint32_t entry;
    float weight;
} WallLink;

#endif
