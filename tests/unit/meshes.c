#include "meshes.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

void mesh_clear(Mesh *mesh, int dimension)
{
    mesh->dimension = dimension;
    mesh->vertices = mesh->elements = 0;
}

static uint32_t add_vertex(Mesh *mesh, double x, double y, double z)
{
    float *v = mesh->vertex + (size_t)mesh->vertices * (size_t)mesh->dimension;
    v[0] = (float)x;
    v[1] = (float)y;
    if (mesh->dimension == 3) v[2] = (float)z;
    return mesh->vertices++;
}

static void add_element(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t corner[3] = {a, b, c};
    memcpy(mesh->element + (size_t)mesh->elements++ * (size_t)mesh->dimension, corner, (size_t)mesh->dimension * sizeof *corner);
}

static void add_square(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_element(mesh, a, b, c);
    add_element(mesh, a, c, d);
}

static void add_circle(Mesh *mesh, double x, double y, double radius, uint32_t corners)
{
    const uint32_t first = mesh->vertices;
    for (uint32_t i = 0; i < corners; i++) {
        const double angle = 2.0 * PI * i / corners;
        add_vertex(mesh, x + radius * cos(angle), y + radius * sin(angle), 0.0);
        add_element(mesh, first + i, first + (i + 1) % corners, 0);
    }
}

void mesh_add_ball(Mesh *mesh, double x, double y, double z, double radius, uint32_t rings)
{
    if (mesh->dimension == 2) {
        add_circle(mesh, x, y, radius, 2 * rings);
        return;
    }
    const uint32_t around = 2 * rings, north = add_vertex(mesh, x, y + radius, z), south = add_vertex(mesh, x, y - radius, z);
    const uint32_t first = mesh->vertices;
    for (uint32_t i = 1; i < rings; i++)
        for (uint32_t j = 0; j < around; j++) {
            const double polar = PI * i / rings, turn = 2.0 * PI * j / around;
            add_vertex(mesh, x + radius * sin(polar) * cos(turn), y + radius * cos(polar), z + radius * sin(polar) * sin(turn));
        }
    for (uint32_t j = 0; j < around; j++) {
        const uint32_t next = (j + 1) % around, last = first + (rings - 2) * around;
        add_element(mesh, north, first + next, first + j);
        add_element(mesh, south, last + j, last + next);
        for (uint32_t i = 0; i + 2 < rings; i++) {
            const uint32_t row = first + i * around;
            add_square(mesh, row + j, row + next, row + around + next, row + around + j);
        }
    }
}

void mesh_add_box(Mesh *mesh, const double centre[3], const double half[3])
{
    const uint32_t first = mesh->vertices;
    if (mesh->dimension == 2) {
        static const int side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (int i = 0; i < 4; i++) add_vertex(mesh, centre[0] + side[i][0] * half[0], centre[1] + side[i][1] * half[1], 0.0);
        for (uint32_t i = 0; i < 4; i++) add_element(mesh, first + i, first + (i + 1) % 4, 0);
        return;
    }
    static const uint32_t face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int i = 0; i < 8; i++)
        add_vertex(mesh, centre[0] + (i & 1 ? 1 : -1) * half[0], centre[1] + (i & 2 ? 1 : -1) * half[1], centre[2] + (i & 4 ? 1 : -1) * half[2]);
    for (int f = 0; f < 6; f++) add_square(mesh, first + face[f][0], first + face[f][1], first + face[f][2], first + face[f][3]);
}

void mesh_add_torus(Mesh *mesh, double ring_radius, double tube_radius, uint32_t rings)
{
    const uint32_t around = 2 * rings, first = mesh->vertices;
    for (uint32_t j = 0; j < around; j++)
        for (uint32_t i = 0; i < rings; i++) {
            const double tube = 2.0 * PI * i / rings, turn = 2.0 * PI * j / around, reach = ring_radius + tube_radius * cos(tube);
            add_vertex(mesh, reach * cos(turn), tube_radius * sin(tube), reach * sin(turn));
        }
    for (uint32_t j = 0; j < around; j++)
        for (uint32_t i = 0; i < rings; i++) {
            const uint32_t here = first + j * rings, next = first + (j + 1) % around * rings, up = (i + 1) % rings;
            add_square(mesh, here + i, here + up, next + up, next + i);
        }
}

void mesh_turn_over(Mesh *mesh, uint32_t first)
{
    for (uint32_t e = first; e < mesh->elements; e++) {
        uint32_t *corner = mesh->element + (size_t)e * (size_t)mesh->dimension;
        const uint32_t swap = corner[0];
        corner[0] = corner[1];
        corner[1] = swap;
    }
}

void mesh_unshare(Mesh *mesh)
{
    static Mesh old;
    const size_t d = (size_t)mesh->dimension;
    old = *mesh;
    mesh->vertices = 0;
    for (size_t i = 0; i < d * old.elements; i++) {
        memcpy(mesh->vertex + d * mesh->vertices, old.vertex + d * old.element[i], d * sizeof(float));
        mesh->element[i] = mesh->vertices++;
    }
}

pbmpm_mesh_def mesh_def_of(const Mesh *mesh, int32_t resolution)
{
    pbmpm_mesh_def def;
    pbmpm_mesh_def_init(&def, sizeof def);
    def.dimension = mesh->dimension;
    def.vertices = mesh->vertex;
    def.elements = mesh->element;
    def.vertex_count = mesh->vertices;
    def.element_count = mesh->elements;
    def.resolution = resolution;
    return def;
}
