/* What the form of a solid says of its motion. */
#ifndef PBMPM_SRC_SHAPE_MASS_H
#define PBMPM_SRC_SHAPE_MASS_H

#include "pbmpm/rigid.h"
#include "shape/shapes.h"

/* [m^d] of a bounded solid. */
double solid_volume(const Solid *solid);

/* Of a bounded solid of even density [kg/m^3], in its own frame. */
pbmpm_mass_properties solid_mass(const Solid *solid, double density);

#endif
