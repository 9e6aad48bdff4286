// Surfaces: particles to points of the lattice, and filters along its lines; see src/skin/field.h.
#include "lanes.isph"
#include "surface_types.h"

#define POINTS 8    // along an axis of a block
#define BOX_AXIS 12 // of its box
#define BOX_MARGIN 2

// The quadratic spline, so far from the particle: with u = max(0, 3/2 - |y|) and v = max(0, 1/2 - |y|) it is u^2 / 2 - 3 v^2 / 2.
static inline float spline(float y) {
    const float u = max(0.0f, 1.5f - abs(y)), v = max(0.0f, 0.5f - abs(y));
    return 0.5f * u * u - 1.5f * v * v;
}

// The first of the points that a particle reaches along an axis, in the box.
static inline int first_of(float at) {
    return (int)(at + 0.5f) - 1;
}

// Where the lanes of a row begin: they reach all of its points, and are written and read again as the same ones, or a processor waits.
static inline uniform int window_of(uniform int first) {
    return programCount <= 4 ? min(first, BOX_AXIS - programCount) : first < 4 ? 0 : BOX_AXIS - programCount;
}

export void surface_splat(const uniform float x[], const uniform float y[], const uniform float z[], const uniform float amount[], uniform int count, uniform float box[]) {
    for (uniform int i = 0; i < count; i += programCount) {
        const int at = min(i + programIndex, count - 1);
        const float place_x = x[at] + BOX_MARGIN, place_y = y[at] + BOX_MARGIN, place_z = z[at] + BOX_MARGIN;
        const int first_x = first_of(place_x), first_y = first_of(place_y), first_z = first_of(place_z);
        const int corner = (first_z * BOX_AXIS + first_y) * BOX_AXIS;
        uniform float share[9][programCount];
        for (uniform int k = 0; k < 3; k++) {
            const float of_plane = amount[at] * spline(k - (place_z - first_z));
            for (uniform int j = 0; j < 3; j++) share[3 * k + j][programIndex] = of_plane * spline(j - (place_y - first_y));
        }
        const uniform int lanes = min(programCount, count - i);
        for (uniform int lane = 0; lane < lanes; lane++) {
            const uniform int window = window_of(extract(first_x, lane));
            const float weight = spline(programIndex - (extract(place_x, lane) - window));
            uniform float *uniform row = box + extract(corner, lane) + window;
            for (uniform int k = 0; k < 3; k++)
                for (uniform int j = 0; j < 3; j++) row[(k * BOX_AXIS + j) * BOX_AXIS + programIndex] += share[3 * k + j][lane] * weight;
        }
    }
}

static const uniform int step_of[3] = {1, POINTS, POINTS * POINTS};

// Along axis 1 or 2; rows along x at once. `pairs` is a constant where it is called: so the loop over taps has no end to test.
static inline void filter_across_x(const uniform struct SurfaceFilter &filter, uniform int pairs, const uniform struct SurfaceRange &within, uniform int axis,
                                   const uniform float *uniform const uniform beside[3], uniform float out[]) {
    const uniform int third = 3 - axis, step = step_of[axis];
    const uniform float *uniform row[3 * POINTS];
    for (uniform int i = 0; i < 3 * POINTS; i++) row[i] = beside[i / POINTS] + i % POINTS * step;
    for (uniform int plane = within.low[third]; plane <= within.high[third]; plane++)
        for (uniform int at = within.low[axis]; at <= within.high[axis]; at++)
            for (uniform int x = 0; x < POINTS; x += programCount) {
                const uniform int offset = plane * step_of[third] + x, low = POINTS + at + filter.first, high = POINTS + at + filter.last;
                float sum = 0.0f;
#pragma unroll
                for (uniform int p = 0; p < pairs; p++) sum += filter.tap[p] * (row[low + p][offset + programIndex] + row[high - p][offset + programIndex]);
                out[offset + at * step + programIndex] = sum;
            }
}

// Lines are laid out first: what has just been written cannot be read at another offset without waiting.
static inline void filter_along_x(const uniform struct SurfaceFilter &filter, uniform int pairs, const uniform struct SurfaceRange &within,
                                  const uniform float *uniform const uniform beside[3], uniform float out[]) {
    uniform float line[POINTS * POINTS][3 * POINTS];
    for (uniform int z = within.low[2]; z <= within.high[2]; z++)
        for (uniform int y = within.low[1]; y <= within.high[1]; y++)
            for (uniform int side = 0; side < 3; side++)
                for (uniform int x = 0; x < POINTS; x += programCount)
                    line[z * POINTS + y][side * POINTS + x + programIndex] = beside[side][(z * POINTS + y) * POINTS + x + programIndex];
    for (uniform int z = within.low[2]; z <= within.high[2]; z++)
        for (uniform int y = within.low[1]; y <= within.high[1]; y++)
            for (uniform int x = 0; x < POINTS; x += programCount) {
                const uniform float *uniform own = &line[z * POINTS + y][POINTS + x];
                float sum = 0.0f;
#pragma unroll
                for (uniform int p = 0; p < pairs; p++) sum += filter.tap[p] * (own[filter.first + p + programIndex] + own[filter.last - p + programIndex]);
                out[(z * POINTS + y) * POINTS + x + programIndex] = sum;
            }
}

static inline void filter_along(const uniform struct SurfaceFilter &filter, uniform int pairs, const uniform struct SurfaceRange &within, uniform int axis,
                                const uniform float *uniform const uniform beside[3], uniform float out[]) {
    if (axis == 0)
        filter_along_x(filter, pairs, within, beside, out);
    else
        filter_across_x(filter, pairs, within, axis, beside, out);
}

// Writes the points of a block that are `within`, made of those before and behind them along an axis. `beside`: the blocks before it, itself and behind it.
export void surface_filter(const uniform struct SurfaceFilter *uniform filter, const uniform struct SurfaceRange *uniform within, uniform int axis,
                           const uniform float *uniform const uniform beside[], uniform float out[]) {
    if (filter->pairs == 2)
        filter_along(*filter, 2, *within, axis, beside, out);
    else
        filter_along(*filter, 4, *within, axis, beside, out);
}

// Adds what three boxes side by side along x say of rows of points. The box before has them behind its own points, the one behind has them before; either may be null.
export void surface_add(const uniform float *uniform const uniform box[], uniform int rows, uniform int planes, uniform float out[]) {
    for (uniform int k = 0; k < planes; k++)
        for (uniform int j = 0; j < rows; j++) {
            const uniform int row = (k * BOX_AXIS + j) * BOX_AXIS;
            uniform float *uniform sum = out + (k * POINTS + j) * POINTS;
            for (uniform int x = 0; x < POINTS; x += programCount) {
                const int at = x + programIndex;
                float own = sum[at];
                if (box[1] != NULL) own += box[1][row + BOX_MARGIN + at];
                if (box[0] != NULL && x < BOX_MARGIN && at < BOX_MARGIN) own += box[0][row + BOX_MARGIN + POINTS + at];
                if (box[2] != NULL && x + programCount > POINTS - BOX_MARGIN && at >= POINTS - BOX_MARGIN) own += box[2][row + at + BOX_MARGIN - POINTS];
                sum[at] = own;
            }
        }
}

// Of the points of a block where T (`more`) is not 0: adds to `enclosed`, for each share k, the room of those with F + k T >= level; and to `held` that of F.
export void surface_weigh(const uniform float own[], const uniform float more[], const uniform float room[], uniform float level, uniform float share_step,
                          uniform float enclosed[], uniform float *uniform held) {
    float sum[K_THICKENINGS + 1], filled = 0.0f;
#pragma unroll
    for (uniform int k = 0; k <= K_THICKENINGS; k++) sum[k] = 0.0f;
    for (uniform int i = 0; i < POINTS * POINTS * POINTS; i += programCount) {
        const float step = share_step * more[i + programIndex], lacks = level - own[i + programIndex];
        if (all(step == 0.0f)) continue;
        const float counts = step == 0.0f ? 0.0f : room[i + programIndex];
        add_to(filled, counts * own[i + programIndex]);
#pragma unroll
        for (uniform int k = 0; k <= K_THICKENINGS; k++) add_to(sum[k], lacks <= k * step ? counts : 0.0f);
    }
#pragma unroll
    for (uniform int k = 0; k <= K_THICKENINGS; k++) enclosed[k] += total(sum[k]);
    *held += total(filled);
}

// Means over the corners of the cubes above a block's points; `box` has the block and what is around it.
export void surface_means(const uniform float box[], uniform float mean[]) {
    for (uniform int row = 0; row < POINTS * POINTS; row++)
        for (uniform int x = 0; x < POINTS; x += programCount) {
            const uniform float *uniform low = box + ((row / POINTS + BOX_MARGIN) * BOX_AXIS + row % POINTS + BOX_MARGIN) * BOX_AXIS + BOX_MARGIN + x;
            float sum = 0.0f;
#pragma unroll
            for (uniform int c = 0; c < 4; c++) {
                const uniform float *uniform pair = low + (c / 2 * BOX_AXIS + c % 2) * BOX_AXIS;
                sum += pair[programIndex] + pair[1 + programIndex];
            }
            mean[row * POINTS + x + programIndex] = 0.125f * sum;
        }
}

export void surface_bound(const uniform float values[], uniform float *uniform least, uniform float *uniform most) {
    float lowest = values[programIndex], highest = values[programIndex];
    for (uniform int i = programCount; i < POINTS * POINTS * POINTS; i += programCount) {
        lowest = min(lowest, values[i + programIndex]);
        highest = max(highest, values[i + programIndex]);
    }
    *least = reduce_min(lowest);
    *most = reduce_max(highest);
}
