/* A pool that sleeps, and some of what wakes it. */
#ifndef PBMPM_TESTS_API_SLEEP_POOL_H
#define PBMPM_TESTS_API_SLEEP_POOL_H

#include "scenes.h"

/* A long pool in 2D: 80 by 8 cells of 0.05 m, 2560 particles in 40 blocks or a few more. */
enum { MOST = 4096, PATIENCE = 600 };
extern const float STILL[3];
extern const float DX, LENGTH, DT; /**< cells and the length of the pool [m], steps [s] */
extern const float PADDLE_X, PADDLE_Y; /**< where the paddle is */
extern const float AT_X; /**< where something happens */

typedef struct pool {
    pbmpm_world_id world;
    pbmpm_material_id water;
    pbmpm_collider_id paddle; /**< kinematic, a cell above the water at PADDLE_X */
    pbmpm_force_id force;     /**< switched off */
    pbmpm_emitter_id emitter; /**< rate 0, above the water at AT_X */
    ledger *book;
} pool;

/** Changes some of the settings of a world. */
void change_settings(pbmpm_world_id world, void (*change)(pbmpm_settings *settings));
void to_sleep(pbmpm_settings *settings); /**< gravity, the dual solver, sleeping after 0.2 s */
void not_at_all(pbmpm_settings *settings);

/** An empty one; `book` (may be null) watches its memory. */
pool make_pool(int32_t threads, ledger *book);
void fill_pool(const pool *made);
void steps(const pool *made, int count);
void rest(const pool *made); /**< steps until everything is asleep and nothing takes part any more */

/** The pool asleep, as a new world; the first time it takes a while. `book` as above. */
pool sleeping_pool(ledger *book);
void forget_pool(void); /**< gives back what sleeping_pool() keeps */

void add_at(const pool *made, float y, float speed); /**< a particle at AT_X */
void a_fast_particle_comes_in(const pool *made);
void particles_are_removed(const pool *made);
void move_paddle(const pool *made, float y, bool at_once);
void an_emitter_begins(const pool *made);
void a_call_wakes_a_shape(const pool *made);
void a_call_wakes_all(const pool *made);

#endif
