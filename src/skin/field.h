/* Sums over particles at the points of the lattice, smooth on the scale of a cell:
 *
 *     F(x) = S sum_p a_p W((x - x_p) / dx),    W: the quadratic B-spline per axis, as in the solver's transfers.
 *
 * With a_p the volume of p in cells the sum is the filling of pbmpm_query_points(): 1 inside, 1/2 at a flat surface. But it is the matter's extent, blurred by W, whose
 * variance is dx^2/4 per axis. A blurred ball of radius R is smaller by dx^2/(4 R), to first order: a sixth of its volume if R is two cells. So S takes the blur's second
 * moment away: S f = f - dx^2/8 f'' along each axis, which is (10 f(x) - f(x - dx) - f(x + dx)) / 8. What is finer than a cell stays smooth.
 *
 * With subdivision 2 points lie h = dx/2 apart, and the wide spline would touch 216 of them. But it is a sum of four narrow ones (C. de Boor, "A Practical Guide to
 * Splines", 1978; G. Chaikin, 1974):
 *     W(y) = (w(y - 3h/2) + 3 w(y - h/2) + 3 w(y + h/2) + w(y + 3h/2)) / 4 per axis,    w: the spline of width h.
 * So particles give to 27 points with w, and a filter of (1, 3, 3, 1) / 8 along each axis makes the sum of it, without error, half a point beside those. Point k of
 * the lattice is at (k - 1/2) h, then. */
#ifndef PBMPM_SRC_SKIN_FIELD_H
#define PBMPM_SRC_SKIN_FIELD_H

#include "skin/blocks.h"
#include "skin/matter.h"

/* What particles count: `count` of them from a row on. */
typedef void FieldAmount(const SkinMatter *matter, uint32_t row, uint32_t count, int channel, float *amount);

/* Their volumes. */
void field_volume(const SkinMatter *matter, uint32_t row, uint32_t count, int channel, float *amount);

struct Boundary;

typedef struct FieldWork {
    SkinBlocks *blocks;
    const SkinMatter *matter;
    Pool *pool;
    const SkinKernels *kernels;
    float *boxes;        /* BOX_POINTS per block with particles: scratch */
    float *sums, *lines; /* BLOCK_POINTS per block, and so are all that follow: scratch */
    float *filling;      /* F */
    float *mirrored;     /* G, see boundary.h, in blocks that are bounded; null where no obstacle stands */
    float *gaps;         /* then null, too; how far [cells] obstacles are, negative inside; infinite where that does not matter */
    float *more;         /* T, see thin.h; null without it */
    float *field;        /* what the surface is cut out of, in blocks that are ended */
    const Layer *mirrored_layer;
    const struct Boundary *boundary;
    uint32_t groups; /* of the materials */
    float level;
    double cell_size;
} FieldWork;

/* From a place in points, as blocks_locate() has it, to one on the lattice. */
static inline float field_shift(const SkinBlocks *blocks) { return blocks->subdivision == 2 ? 0.5f : 0.0f; }

/* Makes F of the particles' volumes, where blocks are `changed` and beside them: those are changed now. Notes its least and most. */
void field_fill(const FieldWork *work);

/* Writes sums of what particles count to `values`, where the surface is. */
void field_make(const FieldWork *work, FieldAmount *amount, int channel, float *values);

enum { SPLAT_MOST = 64 };

/* Particles that are to be added to a block's box. */
typedef struct FieldSplat {
    float *box;
    int count;
    float place[3][SPLAT_MOST], amount[SPLAT_MOST];
} FieldSplat;

/* Its parts. Adds to the 27 points of a block's box around a place, and does what is left of that. */
void field_splat(const FieldWork *work, FieldSplat *splat, const float local[3], float amount);
void field_splat_rest(const FieldWork *work, FieldSplat *splat);
/* A particle's amount is per cell; per point it is as many times as much as there are points in a cell. */
float field_points_per_cell(const SkinBlocks *blocks);
/* Writes the field of the boxes that are splatted to `values`, in the blocks that are `due` and that these reach. Those that `help` are worked on, and those of them that boxes
 * reach are `wanted`. Those of blocks that are `changed` go to `changed`. */
void field_collect(const FieldWork *work, float *values, float *changed);
/* Keeps a block's numbers; whether they are not those that were kept. */
bool field_store(float kept[BLOCK_POINTS], const float made[BLOCK_POINTS]);
/* Points next to a missing block below are out of all particles' reach, though S may leave a ripple there. They are outside, so that the missing block
 * has no vertices: thus the surface is closed whatever the field is. */
void field_close_off(const SkinBlock *block, float values[BLOCK_POINTS]);

#endif
