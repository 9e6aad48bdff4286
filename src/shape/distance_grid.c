#include "shape/distance_grid.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "pbmpm/solid.h"

size_t distance_grid_nodes(const DistanceGrid *grid) { return (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2]; }

/* ---- Looking up ---- */

/* The cell around the point of the grid next to a place, and where in it. */
typedef struct GridPlace {
    size_t first;       /* the cell's lowest node */
    double share[3];    /* in [0, 1] per axis */
    double outside[3];  /* [m] from the grid's box to the place */
    double outside2;    /* its square */
} GridPlace;

static GridPlace place_in(const DistanceGrid *grid, const double local[3])
{
    GridPlace place = {0};
    size_t stride = 1;
    for (int a = 0; a < grid->dimension; a++) {
        const double cells = (local[a] - grid->low[a]) / grid->spacing, most = grid->count[a] - 1;
        const double inside = fmax(0.0, fmin(most, cells));
        const double cell = fmin(floor(inside), most - 1.0);
        place.share[a] = inside - cell;
        place.outside[a] = (cells - inside) * grid->spacing;
        place.outside2 += place.outside[a] * place.outside[a];
        place.first += (size_t)cell * stride;
        stride *= (size_t)grid->count[a];
    }
    return place;
}

/* The interpolated value, and its gradient per spacing. */
static double interpolate(const DistanceGrid *grid, const GridPlace *place, double gradient[3])
{
    const size_t row = (size_t)grid->count[0], layer = row * (size_t)grid->count[1];
    const int layers = grid->dimension == 3 ? 2 : 1;
    const double x = place->share[0], y = place->share[1], z = place->share[2];
    double value[2], along_x[2], along_y[2];
    for (int k = 0; k < layers; k++) {
        const float *v = grid->value + place->first + (size_t)k * layer;
        const double v00 = v[0], v10 = v[1], v01 = v[row], v11 = v[row + 1];
        const double low = v00 + x * (v10 - v00), high = v01 + x * (v11 - v01);
        value[k] = low + y * (high - low);
        along_x[k] = (v10 - v00) + y * ((v11 - v01) - (v10 - v00));
        along_y[k] = high - low;
    }
    gradient[0] = along_x[0];
    gradient[1] = along_y[0];
    gradient[2] = 0.0;
    if (layers == 1) return value[0];
    gradient[0] += z * (along_x[1] - along_x[0]);
    gradient[1] += z * (along_y[1] - along_y[0]);
    gradient[2] = value[1] - value[0];
    return value[0] + z * (value[1] - value[0]);
}

/* Makes a unit vector; of no length at all, one along the first axis. Returns its length. */
static double normalise(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 1e-30)) {
        v[0] = 1.0;
        v[1] = v[2] = 0.0;
        return 0.0;
    }
    for (int a = 0; a < 3; a++) v[a] /= length;
    return length;
}

double distance_grid_at(const DistanceGrid *grid, const double local[3], double normal[3])
{
    const GridPlace place = place_in(grid, local);
    const double distance = interpolate(grid, &place, normal);
    normalise(normal);
    if (place.outside2 == 0.0) return distance;
    for (int a = 0; a < 3; a++) normal[a] = place.outside[a] + distance * normal[a];
    return normalise(normal);
}

/* Interpolating a function whose slope is at most 1 errs by at most half the diagonal of a cell. And the surface lies in the box, so
 * the ways from a place to the nearest point of the box, and on from there to the surface, meet at a right angle or more. */
double distance_grid_least(const DistanceGrid *grid, const double local[3])
{
    double gradient[3];
    const GridPlace place = place_in(grid, local);
    const double least = interpolate(grid, &place, gradient) - 0.5 * grid->spacing * sqrt((double)grid->dimension);
    if (place.outside2 == 0.0) return least;
    return sqrt(place.outside2 + fmax(least, 0.0) * fmax(least, 0.0));
}

/* ---- Moments ---- */

/* About the middle of the grid first, so that places far from the origin lose no digits. */
Moments distance_grid_moments(const DistanceGrid *grid)
{
    double sum = 0.0, first[3] = {0}, square[3] = {0}, product[3] = {0};
    const size_t nodes = distance_grid_nodes(grid);
    for (size_t i = 0; i < nodes; i++) {
        const double share = share_inside((double)grid->value[i] / grid->spacing);
        double x[3] = {0};
        size_t rest = i;
        for (int a = 0; a < grid->dimension; a++) {
            x[a] = (double)(rest % (size_t)grid->count[a]) - 0.5 * (grid->count[a] - 1);
            rest /= (size_t)grid->count[a];
        }
        sum += share;
        for (int a = 0; a < 3; a++) {
            first[a] += share * x[a];
            square[a] += share * x[a] * x[a];
            product[a] += share * x[a] * x[(a + 1) % 3];
        }
    }
    Moments moments = {0};
    if (sum == 0.0) return moments; /* thinner than a cell */
    const double h = grid->spacing;
    moments.volume = sum * (grid->dimension == 3 ? h * h * h : h * h);
    for (int a = 0; a < 3; a++) {
        const double middle = first[a] / sum, other = first[(a + 1) % 3] / sum;
        moments.square[a] = moments.volume * h * h * (square[a] / sum - middle * middle);
        moments.product[a] = moments.volume * h * h * (product[a] / sum - middle * other);
        if (a < grid->dimension) moments.centre[a] = 0.5 * (grid->low[a] + distance_grid_high(grid, a)) + h * middle;
    }
    return moments;
}

/* ---- As bytes ---- */

static const char MAGIC[8] = {'P', 'B', 'M', 'P', 'M', 'S', 'D', 'F'};
enum { VERSION = 1 };

typedef struct Header {
    char magic[8];
    uint32_t version;
    uint32_t dimension;
    int32_t count[3];
    uint32_t reserved; /* 0 */
    double spacing;
    double low[3];
    uint64_t checksum; /* of the header with 0 here, and the values */
} Header;
_Static_assert(sizeof(Header) == 72, "no padding: it is stored as it is");

static uint64_t mix(uint64_t hash, const void *data, size_t bytes)
{
    const unsigned char *byte = data;
    for (size_t i = 0; i < bytes; i += 4) {
        uint32_t word;
        memcpy(&word, byte + i, sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

static uint64_t checksum(Header header, const void *values, size_t bytes)
{
    header.checksum = 0;
    return mix(mix(0x243f6a8885a308d3u, &header, sizeof header), values, bytes);
}

size_t distance_grid_bytes(const DistanceGrid *grid) { return sizeof(Header) + distance_grid_nodes(grid) * sizeof(float); }

void distance_grid_write(const DistanceGrid *grid, void *data)
{
    Header header = {.version = VERSION, .dimension = (uint32_t)grid->dimension, .spacing = grid->spacing};
    const size_t bytes = distance_grid_nodes(grid) * sizeof(float);
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    memcpy(header.count, grid->count, sizeof header.count);
    memcpy(header.low, grid->low, sizeof header.low);
    header.checksum = checksum(header, grid->value, bytes);
    memcpy(data, &header, sizeof header);
    memcpy((char *)data + sizeof header, grid->value, bytes);
}

void distance_grid_seal(void *data, uint64_t size)
{
    Header header;
    memcpy(&header, data, sizeof header);
    header.checksum = checksum(header, (const char *)data + sizeof header, size - sizeof header);
    memcpy(data, &header, sizeof header);
}

static const char *header_problem(const Header *header)
{
    const bool deep = header->dimension == 3;
    if (header->dimension != 2 && !deep) return "its dimension is neither 2 nor 3";
    uint64_t nodes = 1;
    for (int a = 0; a < 3; a++) {
        const int32_t least = a < 2 || deep ? 2 : 1, most = a < 2 || deep ? PBMPM_MAX_BAKED_NODES : 1;
        if (header->count[a] < least || header->count[a] > most) return "its numbers of nodes are out of range";
        nodes *= (uint64_t)header->count[a];
        if (nodes > PBMPM_MAX_BAKED_NODES) return "it has too many nodes";
        if (!(fabs(header->low[a]) <= 1e9)) return "its place is out of range";
    }
    return header->spacing >= 1e-12 && header->spacing <= 1e9 ? NULL : "its spacing is out of range";
}

static bool on_border(const DistanceGrid *grid, size_t node)
{
    for (int a = 0; a < grid->dimension; a++) {
        const size_t place = node % (size_t)grid->count[a];
        if (place == 0 || place == (size_t)grid->count[a] - 1) return true;
        node /= (size_t)grid->count[a];
    }
    return false;
}

/* No more than the grid's own size, and outside at the border. */
static bool values_fit(const DistanceGrid *grid, const char *values)
{
    double size2 = 0.0;
    for (int a = 0; a < grid->dimension; a++) size2 += pow(grid->spacing * grid->count[a], 2.0);
    const size_t nodes = distance_grid_nodes(grid);
    for (size_t i = 0; i < nodes; i++) {
        float value;
        memcpy(&value, values + i * sizeof value, sizeof value);
        if (!((double)value * (double)value <= size2)) return false;
        if (value <= 0.0f && on_border(grid, i)) return false;
    }
    return true;
}

pbmpm_result distance_grid_read(const void *data, uint64_t size, DistanceGrid *grid, const void **values)
{
    Header header;
    if (size < sizeof header)
        return fail(PBMPM_ERROR_DAMAGED, "a baked solid has at least %zu bytes, not %llu", sizeof header, (unsigned long long)size);
    memcpy(&header, data, sizeof header);
    if (memcmp(header.magic, MAGIC, sizeof MAGIC) != 0) return fail(PBMPM_ERROR_DAMAGED, "this is no baked solid: it begins with other bytes");
    if (header.version != VERSION)
        return fail(PBMPM_ERROR_UNSUPPORTED, "the baked solid has format %u; this version reads format %d", header.version, VERSION);
    const char *problem = header_problem(&header);
    if (problem) return fail(PBMPM_ERROR_DAMAGED, "the baked solid is damaged: %s", problem);
    *grid = (DistanceGrid){.dimension = (int)header.dimension, .spacing = header.spacing};
    memcpy(grid->count, header.count, sizeof grid->count);
    memcpy(grid->low, header.low, sizeof grid->low);
    *values = (const char *)data + sizeof header;
    if (size != distance_grid_bytes(grid))
        return fail(PBMPM_ERROR_DAMAGED, "the baked solid is damaged: it should have %zu bytes, not %llu",
                    distance_grid_bytes(grid), (unsigned long long)size);
    if (header.checksum != checksum(header, *values, size - sizeof header))
        return fail(PBMPM_ERROR_DAMAGED, "the baked solid is damaged: its checksum does not fit");
    if (!values_fit(grid, *values)) return fail(PBMPM_ERROR_DAMAGED, "the baked solid is damaged: it holds distances that cannot be");
    return PBMPM_OK;
}
