/* pbmpm: what will go wrong with the present scene and settings, what would help, and what that costs. */
#ifndef PBMPM_ADVICE_H
#define PBMPM_ADVICE_H

#include "collider.h"
#include "material.h"
#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What an advice is about. Cells are counted in cell sizes, and a substep lasts dt / settings.substeps. */
typedef enum pbmpm_advice_code {
    /* Foreseen from the scene and the settings. */
    PBMPM_ADVICE_NO_GRAVITY = 1,       /**< settings.gravity is 0, and no uniform force acts */
    PBMPM_ADVICE_FALLS_FOREVER = 2,    /**< matter has nothing below it along gravity, and no kill bounds take it. Or kill bounds take a part of it that was put
                                            there, before the first step. Figure: share of the matter */
    PBMPM_ADVICE_IGNORED = 3,          /**< a parameter that was changed does nothing here; the text names it. Figure: its value; bound: its default */
    PBMPM_ADVICE_POOL_TOO_DEEP = 4,    /**< a liquid is compressed by its weight. Figure: g dt^2 depth / dx^2, dt the substep's; with the paper's solver
                                            the strain at the bottom */
    PBMPM_ADVICE_POOL_STIRS = 5,       /**< a pool does not come to rest. Foreseen with the dual solver: figure the rms speed [m/s] that such pools have, within a factor of three.
                                            Or came true: liquid that nothing drives moves so five seconds after its first step. A wave of half a cell is faster */
    PBMPM_ADVICE_MODULUS_NOT_HELD = 6, /**< the iterations are too few for the material's modulus. Figure: the Young modulus [Pa] that acts; bound: its own */
    PBMPM_ADVICE_SAND_NOT_HELD = 7,    /**< sand is crushed, comes to rest too flat, or runs too fast or too slowly; the text tells which. Crushed by its weight: figure g dt^2 depth / dx^2, dt the substep's,
                                            with the dual solver and beside liquid; else its mean strain. Crushed where it lands, too flat, or running through a hole: its
                                            speed there [cells per substep] */
    PBMPM_ADVICE_BODY_TOO_THIN = 8,    /**< a body is too thin for the grid. Figure: its thickness [cells] */
    PBMPM_ADVICE_BOUNCE_DAMPED = 9,    /**< the time step damps what bounces: bodies of the dual solver, balls of the primal that fall on obstacles, and bodies that hit each other. Figure: substeps that
                                            the contact of an equally thick ball lasts (Hertz's theory) */
    PBMPM_ADVICE_ROLLING_BRAKED = 10,  /**< a round body rolls too slowly. Figure: half the width of its contact by Hertz's theory [cells] */
    PBMPM_ADVICE_COLLIDER_TOO_FAST = 11, /**< an obstacle moves so fast that it skips past matter. Figure: its displacement in the next substep [cells] */
    PBMPM_ADVICE_COLLIDER_TOO_THIN = 12, /**< an obstacle between matter on both sides is so thin that one side feels the other. Figure: its thickness [cells] */
    PBMPM_ADVICE_STEP_TOO_LONG = 13,   /**< matter or a jet is faster than settings.max_displacement lets it be. Or liquid and bodies enter each other where they
                                            meet. Figure: [cells per substep] */
    PBMPM_ADVICE_OVERLAPS = 17,        /**< before the first step: matter was put where there is other matter. Figure: share of the material that lies in
                                            overfull places; for liquids, of all liquids together */
    PBMPM_ADVICE_KNOWN_LIMIT = 18,     /**< what the library does not do right; the text says what, and what helps if anything does. No figure */
    PBMPM_ADVICE_NO_FRICTION = 19,     /**< sand above a floor of the domain that has no friction, with no obstacle between. Figure: its Coulomb coefficient. Or a liquid
                                            with kinematic_viscosity among walls none of which holds it, or a rigid body on such a floor. Figure: 0 */
    PBMPM_ADVICE_EMITTER_OUTSIDE = 20, /**< an emitter stands wholly beyond a wall of the domain, so it emits nothing. Figure: how far beyond [cells] */
    PBMPM_ADVICE_EMITTER_REFUSED = 21, /**< came true: an emitter found its place full, so it gave less than its rate. Figure: the share that was refused so far */
    PBMPM_ADVICE_COLLIDER_TOO_COARSE = 22, /**< a baked obstacle has too coarse a grid at an edge that liquid or sand comes to. Edges are those of the box around it. Figure:
                                            the width of its grid's cells [cells of the world] */
    /* Came true: measured in the present state. */
    PBMPM_ADVICE_VOLUME_LOST = 14,     /**< matter takes less room than its rest volume. Figure: the share that is lost at least, the measured loss less two standard errors */
    PBMPM_ADVICE_STRAIN_CLAMPED = 15,  /**< a solid is strained to a bound of its material. Figure: share of its particles */
    PBMPM_ADVICE_NOT_SOLVED = 16,      /**< the last substep's solution is far from done. Figure: its predicted error [cells], at most what matter moved by, root mean square */
    PBMPM_ADVICE_CODE_FORCE32 = 0x7fffffff
} pbmpm_advice_code;

/** What would help. */
typedef enum pbmpm_change {
    PBMPM_CHANGE_NONE = 0,       /**< no setting would help, or only one that makes a step more than eight times as dear; see the text */
    PBMPM_CHANGE_SUBSTEPS = 1,   /**< settings.substeps, or the rate in the same proportion */
    PBMPM_CHANGE_ITERATIONS = 2, /**< settings.iterations */
    PBMPM_CHANGE_CELL_SIZE = 3,  /**< world_def.cell_size [m] */
    PBMPM_CHANGE_SOLVER = 4,     /**< settings.solver; the value is a pbmpm_solver */
    PBMPM_CHANGE_GRAVITY = 5,    /**< settings.gravity; the value is a strength [m/s^2] */
    PBMPM_CHANGE_KILL_BOUNDS = 6, /**< pbmpm_world_set_kill_bounds(), or something to fall on */
    PBMPM_CHANGE_PARAMETER = 7,  /**< the parameter; the value is its default */
    PBMPM_CHANGE_YOUNG_MODULUS = 8, /**< material_def.young_modulus [Pa]: a softer body that looks the same at any rate */
    PBMPM_CHANGE_INTEGRATOR = 9, /**< settings.integrator; the value is a pbmpm_integrator */
    PBMPM_CHANGE_COLLIDER = 10,  /**< the obstacle's thickness [m] */
    PBMPM_CHANGE_BAKED_SPACING = 11, /**< the obstacle's grid, baked with more resolution; the value is its baked_info.spacing [m] */
    PBMPM_CHANGE_FORCE32 = 0x7fffffff
} pbmpm_change;

/** One thing that goes wrong with the present scene and settings. */
typedef struct pbmpm_advice {
    uint32_t size;               /**< sizeof(pbmpm_advice); set by the caller in the first element of an array */
    pbmpm_advice_code code;      /**< what */
    pbmpm_material_id material;  /**< whose; all zero: of no material */
    pbmpm_collider_id collider;  /**< whose; all zero: of no obstacle */
    float figure;                /**< what was found; the code says of what */
    float bound;                 /**< the limit that the figure should keep to */
    pbmpm_change change;         /**< which setting would help */
    float value;                 /**< what to set it to, within the setting's range */
    float price;                 /**< what that costs, in percent of a step; negative: not known */
    int32_t came_true;           /**< 1: measured in the present state; 0: foreseen */
    const char *text;            /**< one sentence, constant, valid as long as the library; never null */
} pbmpm_advice;

/** What will go wrong with the present scene and settings when the world is stepped by `dt` [s]. It also tells what came true in the steps so far. Changes nothing.
 *  What is foreseen comes from formulas and measured limits, for the matter that is there or that emitters bring. An empty list is no promise.
 *
 *  Writes up to `capacity` records in the order of their codes' numbers, then of materials and obstacles; *count is the full number. `array` may be null when
 *  capacity is 0; otherwise array[0].size must be set. Costs a quarter to a half of a step of five iterations, and only when called.
 *  It takes memory to sort cells, and gives it back.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (null, dt not in (0, 10]); UNSUPPORTED (size); OUT_OF_MEMORY; BUSY; FORKED.
 *  Any thread, alone in its world. */
PBMPM_API pbmpm_result pbmpm_world_advice(pbmpm_world_id world, float dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count);

/** A short constant name of a code ("PBMPM_ADVICE_NO_GRAVITY"); "PBMPM_ADVICE_UNKNOWN" of a number that is none; never null. Any thread. */
PBMPM_API const char *pbmpm_advice_name(pbmpm_advice_code code);

/** The unit of a code's figure and bound as constant text ("cells"); empty where they have none or a parameter tells it, and of a number that is no code; never null. Any thread. */
PBMPM_API const char *pbmpm_advice_unit(pbmpm_advice_code code);

#ifdef __cplusplus
}
#endif
#endif
