/* pbmpm: liquids, elastic solids, sand and clay (PBMPM_VISCO) in real time by the Position Based Material Point Method.
 *
 * A program makes these calls, each with a structure that its _init() filled:
 *
 *   pbmpm_world_create()         a world: grid, domain, room for particles;
 *   pbmpm_world_set_settings()   gravity, which is 0 until then; the solver;
 *   pbmpm_material_create()      what matter is;
 *   pbmpm_collider_create()      obstacles, if any;
 *   pbmpm_particles_fill()       matter in a shape;
 *   pbmpm_world_step()           once per frame;
 *   pbmpm_particles_view()       what to draw, after each step;
 *   pbmpm_world_destroy()        at the end.
 *
 * Units are SI, angles radians. In 2D masses, forces and energies are per metre of depth. Positions are relative to
 * pbmpm_world_def.origin. Gravity may point anywhere. Only some defaults take +y as up.
 *
 * Every function that can fail returns a pbmpm_result and changes nothing on failure, unless it says otherwise. A create call that
 * fails writes the null identifier.
 * Structures and arrays that you pass are read during the call only, unless a comment says otherwise.
 * Unless it is built with assertions (base.h), the library never aborts, prints, exits or throws.
 *
 * Structures that begin with `size`: it says how much of them the caller knows. Members that an older caller lacks have their
 * defaults; in calls with _set in their name they stay unchanged. A size larger than the library knows is accepted if all bytes
 * beyond are 0. Any other size is UNSUPPORTED. Members named `reserved` must be 0.
 *
 * Method: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks, doi 10.1145/3641233.3664323.
 * Transfers: C. Jiang et al., "The Affine Particle-In-Cell Method", ACM TOG 34(4), 2015; Y. Hu et al., "A Moving Least Squares
 * Material Point Method", ACM TOG 37(4), 2018. */
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
