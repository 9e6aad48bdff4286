/* What walls_find() lists and walls_apply() goes through; see walls.h. */
#ifndef PBMPM_SRC_CONTACT_WALLS_LIST_H
#define PBMPM_SRC_CONTACT_WALLS_LIST_H

#include "base/cholesky.h"
#include "contact/contacts.h"

enum { CORNERS_MAX = 8, NORMALS_MAX = 3 };

#define NO_ENTRY UINT32_MAX

enum { WALL_VECTORS = 3 }; /* of four floats per node in Walls.vector; behind them one per entry */

/* Four floats that the CPU works on at once: a vector and one more, which means nothing. */
typedef float Four __attribute__((vector_size(16)));

typedef struct Columns {
    Four column[3];
} Columns;

/* Of a symmetric matrix, given by its upper triangle row by row. */
static inline Columns symmetric_columns(const float m[6]) { return (Columns){{{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}}}; }

/* Nodes of the list that stand for a place between them. */
typedef struct WallCorner {
    uint32_t parent;
    float weight;
} WallCorner;

/* The motion that a node takes from others: A u~ of a place between them. */
typedef struct WallEntry {
    Columns matrix; /* A */
    uint32_t follower, corner_begin, corner_end;
} WallEntry;

/* Of an entry, while viscosity acts: see wall_shear.h. */
typedef struct WallShear {
    Columns kept;             /* B */
    int face;                 /* of the node: the nearest that holds; NORMALS_MAX: none does, B is 1 */
    Four surface;             /* that wall's motion */
    Four before;              /* the node's u_(j-2) */
    Four given, given_before; /* by the walls, after the last stage and the one before */
} WallShear;

/* The same for the density. */
typedef struct WallMirror {
    uint32_t follower, corner_begin, corner_end;
} WallMirror;

/* What of u~ a node has itself. */
typedef enum WallOwn { OWN_NONE, OWN_PART, OWN_ALL } WallOwn;

/* Walls hold a node or let it go, see walls_unilateral.h. In this walls_apply() a wall did the other. */
enum { UNILATERAL = 1, SWITCHED = 2 };

typedef struct WallNode {
    uint32_t node;  /* of the grid */
    uint32_t entry; /* or NO_ENTRY */
    uint32_t mirror_begin, mirror_end;
    uint32_t link_begin, link_moving, link_end; /* those from link_moving on are for the density */
    float mass;
    float own[6];      /* what of u~ it has itself: a symmetric matrix, the upper triangle row by row */
    float lump[6];     /* M, likewise */
    float shift[3];    /* c0 */
    float own_mirror;  /* share of the density that it keeps */
    float open;        /* share of its weight that is open; negative: not known */
    float normal[NORMALS_MAX][3];
    uint16_t obstacle[NORMALS_MAX];
    uint16_t normals;
    float behind;      /* volume [cells^d] that its spline sees between the wall and the wall's image, see walls_weigh() */
    bool follows;      /* its motion is that of others, or of a wall with matter on both sides, but for what `own` leaves it */
    uint8_t unilateral; /* of these flags */
    bool slips;         /* along its walls it moves by itself */
    float coefficient; /* of friction, on the nearest wall */
    float surface[3];  /* that wall's motion */
} WallNode;

/* Of a WallNode what each walls_apply() needs: of all of them, */
typedef struct WallMotion {
    uint32_t node, entry;
    float mass;
    uint32_t own; /* WallOwn */
    Four shift;   /* c0 */
} WallMotion;

/* and of those that are free: they have something of u~ themselves, or are followed. */
typedef struct WallFree {
    Columns inverse; /* M^-1 */
    uint32_t place;  /* in the list */
    uint32_t link_begin, link_moving;
    uint32_t unsure; /* its masses hang on nodes that walls may let go */
} WallFree;

/* A node that follows the wall of a rigid body: where that moves by y and turns by r, the node moves by D (y + r x arm). */
typedef struct WallGrip {
    Columns share; /* D */
    Four arm;      /* of the wall's foot, from what the body turns about [cells] */
    uint32_t follower, body;
} WallGrip;

/* A rigid body among the walls, see wall_bodies.h. Motions are displacements [cells], then turns. */
typedef struct WallBody {
    FreeBody *free;
    int obstacle;
    bool gripped;       /* a node follows it */
    double way[6][6];   /* the columns of B, for momenta as the nodes count them */
    SmallMatrix factor; /* L, with L L^T = 1 + B^T S B */
    double before[6];   /* its motion in this substep beside the obstacle's own, but for */
    double given[6];    /* G, of the last walls_apply() */
    double yield[6];    /* y, likewise, and */
    double yielded[6];  /* of the last one with the walls' own motion */
} WallBody;

#define NO_GRIP UINT32_MAX

/* What each wall does to a node while that holds it, see walls_unilateral.h. */
typedef struct WallUnilateral {
    uint32_t follower;
    uint32_t held;               /* bit j: face j of the node holds it */
    uint32_t grip[NORMALS_MAX];  /* where that is a rigid body's, or NO_GRIP */
    float scale[NORMALS_MAX];    /* share of the motion before it; 1: it is clear of that face */
    float surface[NORMALS_MAX];  /* the wall's own motion along its normal */
} WallUnilateral;

/* Who follows a node: an entry, or for the density the node itself. */
typedef struct WallLink {
    uint32_t from;
    float weight;
} WallLink;

typedef struct Walls {
    Array node;       /* WallNode: nodes at walls, then those that they follow */
    Array motion;     /* WallMotion of each */
    Array free;       /* WallFree of those that are free */
    Array moved;      /* uint32_t: the places of those that do not move as they are free to */
    Array entry;      /* WallEntry, in the order of the nodes that follow */
    Array shear;      /* WallShear per entry, if the frame is viscous */
    Array mirror;     /* WallMirror, likewise */
    Array corner;     /* WallCorner of both */
    Array link;       /* WallLink: per node that is followed, who follows */
    Array place;      /* uint32_t per node of the grid: which of the nodes it is + 1, or 0 */
    Array marked;     /* uint64_t per node block: bit n, node n is at a wall */
    Array begin;      /* uint32_t per node block: how many such nodes are in blocks before */
    Array bound;      /* per such node: its faces */
    Array vector;     /* per node: what is passed between loops */
    Array unilateral; /* WallUnilateral, in the order of the nodes that follow */
    Array grip;       /* WallGrip, in the order of the nodes that follow */
    Array body;       /* WallBody */
    Array scratch;    /* while they are found */
    Array beside_body; /* uint32_t: which of the free nodes rigid bodies move */
    uint32_t nodes, frees, moves, entries, shears, mirrors, corners, unilaterals, grips, bodies, beside;
    bool rubs;        /* a wall has friction */
} Walls;

static inline Four times(const Columns *m, Four v) { return m->column[0] * v[0] + m->column[1] * v[1] + m->column[2] * v[2]; }

static inline Four cross(Four a, Four b) { return (Four){a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

#endif
