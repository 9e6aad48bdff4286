/* Matter at walls, wherever they stand.
 *
 * The supports of nodes reach through a wall, to where no particles are. A pressure that is the same everywhere may do no work on any motion that a wall
 * admits, and nothing may pass the wall: along its normal n, with phi the distance in cells and w the spline,
 *     sum_i k(phi_i) n.u_i = 0,   k(phi) = 4 int_|phi|^1.5 t w(t) dt,   and   sum_i w(phi_i) n.u_i = 0.
 * Of what the nodes within 1.5 cells can do that leaves n.u proportional to phi. So nodes closer than half a cell follow nodes before them: along the normal in
 * proportion to phi, along the wall as they are. In a hollow edge or corner this holds for each face. With u~ of the nodes that are free,
 *     u = E u~ + c0,   and   u~ = M^-1 E^T (p - m c0)
 * where p is the momentum (mass times displacement), c0 the wall's own motion, and M >= E^T m E is lumped at the nodes. The map from p to u is symmetric, and its
 * norm is at most that of 1/m (Jensen's inequality), as dual.isph needs. Midway between grid lines it is the reflection of all matter in the wall.
 * A wall pushes and does not pull. Solids it lets go at once, see walls_unilateral.h. Liquid that leaves faster than the pressure before it turns it is not held, see
 * leaves() in walls_find.c.
 * What nodes behind a wall do along it by themselves, as a mirror's do off the grid, is a motion that few iterations do not see: it drove fountains.
 *
 * At outer edges, blunt inner ones and curved walls a node has one normal: the slope of the distances at the nodes around it. It turns as slowly as the spline sees
 * the wall turn. The nearest face's own leaps there, and an even pressure then drives water round the edge: a pool with a box in it stirred at 0.2 m/s.
 *
 * The density is found on folded nodes: mass and open share of nodes within a cell are reflected in the wall.
 *
 * What changes the momentum of nodes is booked by wall: the sum over nodes of m u - p, each node's share going to the wall that it lies at. */
#ifndef PBMPM_SRC_CONTACT_WALLS_H
#define PBMPM_SRC_CONTACT_WALLS_H

#include "contact/walls_list.h"

void walls_free(Walls *walls, Memory *memory);
void walls_clear(Walls *walls);
static inline bool walls_any(const Walls *walls) { return walls->nodes > 0; }

/* Lists the nodes at walls; needs the masses of the predictor and frame->gap. */
pbmpm_result walls_find(Walls *walls, const ContactFrame *frame, Memory *memory, Pool *pool);

/* Which of the listed nodes a node of the grid is, + 1; 0: none. `walls` may be null. */
static inline uint32_t walls_place(const Walls *walls, uint32_t node) { return walls && walls->nodes > 0 ? ((const uint32_t *)walls->place.data)[node] : 0; }

/* Whether it is listed, and whether its normal part follows others: then it has no contact of its own. */
static inline bool walls_list(const Walls *walls, uint32_t node) { return walls_place(walls, node) > 0; }
bool walls_hold(const Walls *walls, uint32_t node);

/* Whether it follows nodes before it. */
bool walls_follows(const Walls *walls, uint32_t node);

/* The obstacles that a listed node is at, the nearest first, and their normals there. Returns their number. */
int walls_faces(const Walls *walls, uint32_t node, uint16_t obstacle[3], const float *normal[3]);

/* What a listed node follows: nodes of the grid, weights that add up to 1, and A of its entry. Returns how many; 0: it follows none. */
int walls_parents(const Walls *walls, uint32_t node, uint32_t parent[CORNERS_MAX], float weight[CORNERS_MAX], Columns *matrix);

/* By which share of the motion before it each face of a listed node lets it go on, if they are unilateral: see walls_unilateral.h. Returns the number of faces; 0:
 * none is. */
int walls_scales(const Walls *walls, uint32_t node, float scale[3]);

/* The displacement [cells] of the nearest wall, at a listed node. */
void walls_motion(const Walls *walls, uint32_t node, float motion[3]);

/* Makes the displacements of the nodes admissible. In between contacts of nodes farther off are obeyed. `linear`: for responses, without the walls' own motion,
 * without friction and contacts but for those of nodes that touch. `mark`: only nodes in marked blocks have new momenta; null: all. */
void walls_apply(const Walls *walls, const ContactFrame *frame, Pool *pool, bool linear, const uint8_t *mark);

/* The same as loops that are added to others. */
void walls_add(const Walls *walls, const ContactFrame *frame, Loops *loops, bool linear, const uint8_t *mark);

/* The spline sees a wall that turns farther off, phi~ in place of phi. Where a pressure grows with depth, matter between the wall and that image would bear it: to first
 * order the volume sum w(phi) (phi~ - phi), a quarter of a cell along the edge of a box. It is missing, so water rose along the edges for ever, and bodies were lifted as if they
 * were smaller. So the wall gives its weight to the nodes that are followed, as of matter that is as dense as there. To be called before walls are obeyed.
 * `gravity`: of the substep [cells]; `base`: 4 floats per node, changed as the nodes are. */
void walls_weigh(const Walls *walls, const ContactFrame *frame, const float gravity[3], float *base);

/* Adds what matter at `place` gained from face number `face` of a listed node [kg m/s] to the impulse of its obstacle. */
void walls_book_face(const ContactFrame *frame, const WallNode *n, int face, const WallNode *place, const double gained[3]);

/* Adds what the walls gave to matter in the last walls_apply() to the impulses of their obstacles. */
void walls_book(const Walls *walls, const ContactFrame *frame);

/* Of a listed node: the momentum that it had in the last walls_apply() times its displacement. */
float walls_work(const Walls *walls, uint32_t node, const float *u);

/* What a listed node adds to the least value of 1/2 (u~, M u~) - (E u~ + c0, m u* + q), with u the displacement that has it, base that of the predictor and q the
 * push: -(u - c0) . (m u* + q - m c0) / 2 - c0 . q, and m/2 |u*|^2 as elsewhere. */
float walls_value(const Walls *walls, uint32_t node, const float *u, const float *base, const float *push);

/* The share of a node of the grid that is open, if it is known; else negative. */
float walls_open_share(const Walls *walls, uint32_t node);

/* node_volume, rest volume per cell, becomes rest volume per open volume at nodes near walls. `open`: per node of the grid the share that is open; it becomes 1
 * there. */
void walls_fold_volume(const Walls *walls, float *volume, float *open);

#endif
