#include "shape/mass.h"

static const double PI = 3.14159265358979323846;

static Moments box_moments(const Solid *s)
{
    Moments m = {.volume = 1.0};
    for (int a = 0; a < s->dimension; a++) m.volume *= 2.0 * s->half_extents[a];
    for (int a = 0; a < s->dimension; a++) m.square[a] = m.volume * s->half_extents[a] * s->half_extents[a] / 3.0;
    return m;
}

/* A cylinder (2D: a rectangle) with half a ball (2D: disc) on each end; a ball has none between them. A half's centre is 3/8 (2D: 4/(3 pi)) of its
 * radius from its base. */
static Moments round_moments(const Solid *s)
{
    const double r = s->radius, a = s->kind == PBMPM_CAPSULE ? s->half_extents[0] : 0.0;
    const bool deep = s->dimension == 3;
    const double straight = deep ? 2.0 * PI * r * r * a : 4.0 * r * a, round = deep ? 4.0 / 3.0 * PI * r * r * r : PI * r * r;
    const double off = deep ? 3.0 / 8.0 * r : 4.0 / (3.0 * PI) * r;
    const double across = straight * r * r / (deep ? 4.0 : 3.0) + round * r * r / (deep ? 5.0 : 4.0);
    Moments m = {.volume = straight + round, .square = {0.0, across, deep ? across : 0.0}};
    m.square[0] = straight * a * a / 3.0 + round * (r * r / (deep ? 5.0 : 4.0) + a * a + 2.0 * a * off);
    return m;
}

static Moments moments_of(const Solid *s)
{
    switch (s->kind) {
    case PBMPM_BOX: return box_moments(s);
    case PBMPM_SPHERE:
    case PBMPM_CAPSULE: return round_moments(s);
    case PBMPM_BAKED: return s->grid->moments;
    case PBMPM_PLANE: /* is refused before */
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return (Moments){0};
}

double solid_volume(const Solid *s) { return moments_of(s).volume; }

pbmpm_mass_properties solid_mass(const Solid *s, double density)
{
    const Moments m = moments_of(s);
    pbmpm_mass_properties mass = {.size = sizeof mass, .volume = m.volume, .mass = density * m.volume};
    for (int a = 0; a < 3; a++) {
        mass.centre[a] = m.centre[a];
        if (s->dimension == 2 && a < 2) continue;
        mass.inertia[a] = density * (m.square[(a + 1) % 3] + m.square[(a + 2) % 3]);
    }
    for (int a = 0; a < 3 && s->dimension == 3; a++) mass.products[a] = -density * m.product[a];
    return mass;
}
