/* The triangles of the surface F = level, by the cases of cases.h.
 *
 * A vertex stands on an edge of the lattice that the surface cuts. It is the vertex of the edge's lower point, and so of one block; all others find it there by its
 * number. So blocks meet without a seam, and work on their own. */
#ifndef PBMPM_SRC_SKIN_MESH_H
#define PBMPM_SRC_SKIN_MESH_H

#include "skin/blocks.h"
#include "skin/cases.h"

typedef struct SkinMesh {
    const SkinBlocks *blocks;
    const Cases *cases;
    Pool *pool;
    const Layer *field;
    uint8_t *inside;    /* per point: of the cube above it, if it is cut, its inside corners */
    uint16_t *start;    /* there too: vertices of the block before those of the point */
    float level;
    double spacing; /* of points [m] */
    double first;   /* of the lattice beside the grid's [points] */
} SkinMesh;

/* Numbers of each kind per vertex, `stride` bytes from one to the next; not written where `base` is null. */
typedef struct MeshStream {
    char *base;
    size_t stride;
} MeshStream;

/* Counts where blocks are changed, and numbers the vertices. Returns how many are. */
int32_t mesh_count(const SkinMesh *mesh, uint64_t *vertices, uint64_t *triangles);

void mesh_write_places(const SkinMesh *mesh, MeshStream positions, MeshStream normals);
/* Three per triangle, of 2 or 4 bytes. */
void mesh_write_indices(const SkinMesh *mesh, void *indices, uint32_t index_bytes);
/* The mean of a quantity, of which `values` are sums with the weights `weights`. */
void mesh_write_mean(const SkinMesh *mesh, const float *values, const float *weights, MeshStream out);

#endif
