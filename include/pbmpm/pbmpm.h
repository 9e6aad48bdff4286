/* pbmpm: liquids, elastic solids, sand and clay in real time by the Position Based Material Point Method.
 *
 * Method: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks, doi 10.1145/3641233.3664323.
 * Transfers: C. Jiang et al., "The Affine Particle-In-Cell Method", ACM TOG 34(4), 2015; Y. Hu et al., "A Moving Least
 * Squares Material Point Method", ACM TOG 37(4), 2018.
 *
 * Units are SI, angles radians. No axis is "up": gravity may point anywhere. Every function that
 * can fail returns a pbmpm_result and changes nothing on failure unless it says otherwise. Unless it is built with assertions
 * (base.h), the library never aborts, prints, exits or throws. */
#ifndef PBMPM_H
#define PBMPM_H

#include "advice.h"
#include "async.h"
#include "base.h"
#include "collider.h"
#include "debug.h"
#include "drain.h"
#include "emitter.h"
#include "force.h"
#include "material.h"
#include "particles.h"
#include "query.h"
#include "rigid.h"
#include "shape.h"
#include "sleep.h"
#include "solid.h"
#include "snapshot.h"
#include "stats.h"
#include "surface.h"
#include "version.h"
#include "world.h"

#endif
