/* pbmpm: what will go wrong with the present scene and settings, what would help, and what that costs. */
#ifndef PBMPM_ADVICE_H
#define PBMPM_ADVICE_H

#include "collider.h"
#include "material.h"
#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What an advice is about. "Figure" is pbmpm_advice.figure, "bound" is pbmpm_advice.bound. [cells]: lengths over the cell size.
 *  dt: the length of a substep, dx: the cell size. */
typedef enum pbmpm_advice_code {
    /* Foreseen from the scene and the settings. */
    PBMPM_ADVICE_NO_GRAVITY = 1,       /**< settings.gravity is 0, and no uniform force acts */
    PBMPM_ADVICE_FALLS_FOREVER = 2,    /**< matter or an emitter has nothing below it along gravity, and no kill bounds take the
                                            matter. Or, before the first step, part of it lies where only the kill bounds take it.
                                            Figure: share */
    PBMPM_ADVICE_IGNORED = 3,          /**< a changed parameter has no effect here; the text names it. Figure: it; bound: its
                                            default */
    PBMPM_ADVICE_POOL_TOO_DEEP = 4,    /**< a liquid is compressed by its weight. Figure: g dt^2 depth / dx^2, depth in metres;
                                            paper's solver: the strain at the bottom */
    PBMPM_ADVICE_POOL_STIRS = 5,       /**< a pool keeps moving. Figure: its rms speed [m/s]. Foreseen (dual solver): within a
                                            factor of three. Came true: measured from five seconds after the first step on, where
                                            nothing drives the liquid; not if it may be a wave of half a cell or more */
    PBMPM_ADVICE_MODULUS_NOT_HELD = 6, /**< the iterations are too few for the material's modulus. Figure: the Young modulus [Pa]
                                            that acts; bound: its own */
    PBMPM_ADVICE_SAND_NOT_HELD = 7,    /**< sand is crushed, lies too flat, or runs too fast or slowly; the text tells which.
                                            Crushed by its weight: figure g dt^2 depth / dx^2 (dual solver, or beside liquid), else
                                            its mean strain. Landing, sliding or running: figure its speed [cells per substep] */
    PBMPM_ADVICE_BODY_TOO_THIN = 8,    /**< a body is too thin for the grid. Figure: its thickness [cells] */
    PBMPM_ADVICE_BOUNCE_DAMPED = 9,    /**< a contact is too short for the time step, so a body bounces too little. Figure: substeps
                                            that the contact of an equally thick ball lasts (Hertz's theory) */
    PBMPM_ADVICE_ROLLING_BRAKED = 10,  /**< a round body rolls too slowly. Figure: half of its contact's width (Hertz) [cells] */
    PBMPM_ADVICE_COLLIDER_TOO_FAST = 11, /**< an obstacle skips past matter. Figure: its way in the next substep [cells] */
    PBMPM_ADVICE_COLLIDER_TOO_THIN = 12, /**< an obstacle is so thin that its two sides feel each other. Figure: thickness
                                              [cells] */
    PBMPM_ADVICE_STEP_TOO_LONG = 13,   /**< matter is too fast for settings.max_displacement, or liquid and bodies enter each other
                                            where they meet. Figure: its speed, or that at which they meet [cells per substep] */
    PBMPM_ADVICE_OVERLAPS = 17,        /**< before the first step: matter was put where other matter is. Figure: share of the
                                            material that lies in overfull places; for liquids, of all liquids together */
    PBMPM_ADVICE_KNOWN_LIMIT = 18,     /**< what the library does not do right; the text says what, and what helps. No figure */
    PBMPM_ADVICE_NO_FRICTION = 19,     /**< sand, viscous liquid or a rigid body rests on walls without friction. Figure: sand: the
                                            Coulomb coefficient of the domain's floor; else 0 */
    PBMPM_ADVICE_EMITTER_OUTSIDE = 20, /**< an emitter is wholly outside the domain, so it emits nothing. Figure: how far [cells] */
    PBMPM_ADVICE_EMITTER_REFUSED = 21, /**< came true: an emitter found its place full, so it gave less than its rate. Figure: the
                                            share that was refused so far */
    PBMPM_ADVICE_COLLIDER_TOO_COARSE = 22, /**< a baked obstacle's grid is too coarse at an edge where liquid or sand gets. Only
                                                edges of its bounding box are looked at. Figure: the width of its grid's cells
                                                [cells of the world] */
    /* Came true: measured in the present state. */
    PBMPM_ADVICE_VOLUME_LOST = 14,     /**< matter takes less room than its rest volume. Figure: the share that is lost at least
                                            (measured less two standard errors) */
    PBMPM_ADVICE_STRAIN_CLAMPED = 15,  /**< a solid is strained to a bound of its material. Figure: share of its particles */
    PBMPM_ADVICE_NOT_SOLVED = 16,      /**< the last substep did not converge. Figure [cells]: predicted rms error, at most rms
                                            motion */
    PBMPM_ADVICE_CODE_FORCE32 = 0x7fffffff
} pbmpm_advice_code;

/** What would help. */
typedef enum pbmpm_change {
    PBMPM_CHANGE_NONE = 0,       /**< no setting helps for less than eight times the step time; see the text. `value`, `price`: 0 */
    PBMPM_CHANGE_SUBSTEPS = 1,   /**< settings.substeps, or the rate (steps per second) in the same proportion */
    PBMPM_CHANGE_ITERATIONS = 2, /**< settings.iterations */
    PBMPM_CHANGE_CELL_SIZE = 3,  /**< world_def.cell_size [m] */
    PBMPM_CHANGE_SOLVER = 4,     /**< settings.solver; the value is a pbmpm_solver */
    PBMPM_CHANGE_GRAVITY = 5,    /**< settings.gravity; the value is a strength [m/s^2] */
    PBMPM_CHANGE_KILL_BOUNDS = 6, /**< pbmpm_world_set_kill_bounds(), or something to fall on */
    PBMPM_CHANGE_PARAMETER = 7,  /**< the parameter; the value is its default */
    PBMPM_CHANGE_YOUNG_MODULUS = 8, /**< material_def.young_modulus [Pa]: a softer body that looks the same at any rate */
    PBMPM_CHANGE_INTEGRATOR = 9, /**< settings.integrator; the value is a pbmpm_integrator */
    PBMPM_CHANGE_COLLIDER = 10,  /**< the obstacle's thickness [m] */
    PBMPM_CHANGE_BAKED_SPACING = 11, /**< more resolution of the obstacle's baked grid; the value is its baked_info.spacing [m] */
    PBMPM_CHANGE_FORCE32 = 0x7fffffff
} pbmpm_change;

/** One thing that goes wrong with the present scene and settings. */
typedef struct pbmpm_advice {
    uint32_t size;               /**< sizeof(pbmpm_advice); set by the caller in the first element of an array */
    pbmpm_advice_code code;      /**< what it is about */
    pbmpm_material_id material;  /**< the material; all zero: none */
    pbmpm_collider_id collider;  /**< the obstacle; all zero: none */
    float figure;                /**< what was found, as the code says */
    float bound;                 /**< the limit that the figure should keep to */
    pbmpm_change change;         /**< which setting would help */
    float value;                 /**< what to set it to, within the setting's range */
    float price;                 /**< extra time per step [percent]; 100 doubles it; negative: not known */
    int32_t came_true;           /**< 1: measured in the present state; 0: foreseen */
    const char *text;            /**< one sentence, constant, valid as long as the library; never null */
} pbmpm_advice;

/** What will go wrong with the present scene and settings when the world is stepped by `dt` [s]. It also tells what came true in
 *  the steps so far. Changes nothing. What is foreseen comes from formulas and measured limits, for the matter that is there or
 *  that emitters bring. An empty list is no promise.
 *
 *  Writes up to `capacity` records in the order of their codes' numbers; *count is the full number. `array` may be null when
 *  capacity is 0; otherwise array[0].size must be set. Costs a quarter to a half of a step of five iterations, and only when
 *  called. It takes memory to sort cells, and gives it back.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (null, dt not in (0, 10]); UNSUPPORTED (size); OUT_OF_MEMORY; BUSY; FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_advice(pbmpm_world_id world, float dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count);

/** A short constant name of a code ("PBMPM_ADVICE_NO_GRAVITY"); "PBMPM_ADVICE_UNKNOWN" for other numbers; never null.
 *  Threads: any. */
PBMPM_API const char *pbmpm_advice_name(pbmpm_advice_code code);

/** The unit of a code's figure and bound as constant text ("cells"); never null. Empty if there is no unit, if it depends on the
 *  case, or if the code is unknown. Threads: any. */
PBMPM_API const char *pbmpm_advice_unit(pbmpm_advice_code code);

#ifdef __cplusplus
}
#endif
#endif
