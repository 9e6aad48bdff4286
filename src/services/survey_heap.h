/* What a survey finds. */
#ifndef PBMPM_SRC_SERVICES_SURVEY_HEAP_H
#define PBMPM_SRC_SERVICES_SURVEY_HEAP_H

#include "pbmpm/pbmpm.h"

#include <stdbool.h>
#include <stdint.h>

/* Matter of one material. Lengths in cells, as rest volume fills them: what is compressed is as thick as it was. */
typedef struct Heap {
    uint32_t particles;
    double speed;      /* the fastest [m/s] */
    double moves;      /* root mean square speed [m/s] */
    double depth;      /* along the axis that gravity pulls along most; that of all liquids together for a liquid; 0 without gravity */
    double width;      /* the same across it, along the axis where that is least */
    double thickness;  /* the least over the axes, where it is thickest */
    double uneven;     /* how far its surface is from level, root mean square over columns of three cells and more; of all liquids together; 0 for solids */
    double leans;      /* share of what holds it up that leans by 3 to 63 degrees from gravity's axis; of all liquids together; 0 for solids */
    double filling;    /* mean rest volume per cell volume inside; 0 where too few cells are inside */
    double filling_error; /* standard error of that mean */
    double kept;       /* mean det F: the share of its rest volume that its strain says it takes; solids */
    double overlapping; /* share of it, or of all liquids, that lies in cells with too much matter; before the first step */
    bool round;        /* whether most of it is in bodies that are as round as a ball, a disc or a short cylinder; solids */
    double lever;      /* the least [cells] by which the weight of a body lies beyond all that holds it; 0: of none does, or nothing holds it; elastic, not round */
    double steep;      /* share of its surface that has room below, at more than a solid's angle of friction; sand */
    double slide;      /* how far its surface may go down there, at most; sand */
    bool falls_both_ways; /* it has so to both sides along an axis */
    double drop_least, drop_half, drop_most; /* how far it falls freely before it lands, over places: of all, of half, of the farthest; 0 if it never lands; solids */
    double hole;       /* width [cells] of where it would fall farther than elsewhere by four cells at least; in 3D that of a square; solids */
    bool hangs;        /* whether nothing within two cells bears a body from below, and another one is less than two cells above it; solids but sand */
    double film;       /* share of its upper side with a film of liquid on it, under air; solids */
    bool lies;         /* whether each of its bodies lies on an obstacle; solids beside liquid */
    bool on_matter;    /* whether it stands on other matter, or falls onto it, anywhere; solids */
    double narrow;     /* share of a solid, among liquid, with obstacles less than five cells away on both sides along each axis across gravity */
    double clamped;    /* share of particles that are strained to a bound; solids */
} Heap;

typedef struct Survey {
    Heap heap[PBMPM_MAX_MATERIALS];
    double meets; /* the fastest [m/s] of liquid that goes where a body is within four cells ahead, or of a body that goes where liquid is; not sand */
    bool ball_below; /* whether a ball or a capsule stands lower than liquid that nothing parts from it */
    bool ball_dry;   /* whether one of these is such that no liquid is within two cells of it */
} Survey;

#endif
