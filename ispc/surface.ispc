// Surfaces: particles to points of the lattice, and filters along its lines; see src/skin/field.h.
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
    return programCount <= 4 ? first : first < 4 ? 0 : BOX_AXIS - programCount;
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

// Sums of rows of points: `line` has them in order; the taps are in pairs, the first of which is `first` rows before.
export void surface_filter(const uniform float *uniform const uniform line[], const uniform float tap[], uniform int pairs, uniform int first, uniform int last,
                           uniform int begin, uniform int end, uniform float out[], uniform int step) {
    for (uniform int at = begin; at < end; at++)
        for (uniform int x = 0; x < POINTS; x += programCount) {
            float sum = 0.0f;
            for (uniform int p = 0; p < pairs; p++) sum += tap[p] * (line[at + first + p][x + programIndex] + line[at + last - p][x + programIndex]);
            out[at * step + x + programIndex] = sum;
        }
}

// Along rows: each has `POINTS` before and behind it.
export void surface_filter_row(const uniform float line[], const uniform float tap[], uniform int pairs, uniform int first, uniform int last, uniform float out[]) {
    for (uniform int x = 0; x < POINTS; x += programCount) {
        float sum = 0.0f;
        for (uniform int p = 0; p < pairs; p++) sum += tap[p] * (line[POINTS + x + first + p + programIndex] + line[POINTS + x + last - p + programIndex]);
        out[x + programIndex] = sum;
    }
}
