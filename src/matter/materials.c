#include "matter/materials.h"

#include <float.h>
#include <math.h>

#include "base/numbers.h"
#include "base/result.h"

/* All kinds there are: what a build may leave out, and how it is called there. */
static const struct {
    const char *name;
    bool built;
} kinds[] = {
    [PBMPM_LIQUID] = {"liquid", PBMPM_WITH_LIQUID},
    [PBMPM_ELASTIC] = {"elastic", PBMPM_WITH_ELASTIC},
    [PBMPM_SAND] = {"sand", PBMPM_WITH_SAND},
    [PBMPM_VISCO] = {"visco", PBMPM_WITH_VISCO},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

uint32_t materials_built(void)
{
    uint32_t built = 0;
    for (uint32_t kind = 0; kind < KINDS; kind++) built |= (uint32_t)kinds[kind].built << kind;
    return built;
}

pbmpm_result material_kind_usable(pbmpm_material_kind kind)
{
    if (!in_enum(kind, PBMPM_LIQUID, KINDS - 1)) return fail(PBMPM_ERROR_UNSUPPORTED, "material.kind is not known to this version");
    if (kinds[kind].built) return PBMPM_OK;
    return fail(PBMPM_ERROR_UNSUPPORTED, "this library was built without %s materials; the CMake option PBMPM_MATERIALS says what is built",
                kinds[kind].name);
}

pbmpm_material_def material_defaults(void)
{
    return (pbmpm_material_def){.size = sizeof(pbmpm_material_def),
                                .kind = PBMPM_LIQUID,
                                .density = 1000.0f,
                                .relaxation = 1.5f,
                                .viscosity = 0.0f,
                                .volume_feedback = VOLUME_FEEDBACK,
                                .elasticity_ratio = 1.0f,
                                .strain_policy = PBMPM_STRAIN_CLAMP,
                                .strain_min = 0.1f,
                                .strain_max = 20.0f,
                                .condition_max = 1e6f,
                                .rebound_max = 1.0f,
                                .elastic_model = PBMPM_FIXED_COROTATED,
                                .young_modulus = 1e5f,
                                .poisson_ratio = 0.3f,
                                .friction_angle = 0.52359878f,
                                .volume_correction = 1,
                                .yield_strain = 0.05f,
                                .flow_rate = 100.0f,
                                .groups = 1};
}

static const char *modulus_problem(const pbmpm_material_def *def)
{
    if (def->bulk_modulus != 0.0f && !in_range(def->bulk_modulus, 1e-3, 1e15))
        return "material.bulk_modulus must be 0 (incompressible) or in [1e-3, 1e15]";
    if (!in_range(def->kinematic_viscosity, 0.0, 1e6)) return "material.kinematic_viscosity must be in [0, 1e6]";
    if (!in_enum(def->elastic_model, PBMPM_FIXED_COROTATED, PBMPM_NEO_HOOKEAN)) return "material.elastic_model is unknown";
    if (!in_range(def->young_modulus, 1e-3, 1e15)) return "material.young_modulus must be in [1e-3, 1e15]";
    if (!in_range(def->poisson_ratio, 0.0, 0.495)) return "material.poisson_ratio must be in [0, 0.495]";
    return NULL;
}

static const char *yield_problem(const pbmpm_material_def *def)
{
    const bool plastic = def->kind == PBMPM_SAND || def->kind == PBMPM_VISCO;
    if (plastic && def->elasticity_ratio < 0.01f) return "material.elasticity_ratio of sand and visco must be in [0.01, 1]";
    if (!in_range(def->friction_angle, 0.0, 1.4)) return "material.friction_angle must be in [0, 1.4] radians";
    if (!in_range(def->cohesion, 0.0, 0.5)) return "material.cohesion must be in [0, 0.5]";
    if (def->volume_correction > 1) return "material.volume_correction must be 0 or 1";
    if (!in_range(def->yield_strain, 0.0, 10.0)) return "material.yield_strain must be in [0, 10]";
    if (!in_range(def->flow_rate, 0.0, 1e9)) return "material.flow_rate must be in [0, 1e9]";
    return NULL;
}

const char *material_problem(const pbmpm_material_def *def)
{
    if (!in_enum(def->kind, PBMPM_LIQUID, KINDS - 1)) return "material.kind is not known to this version";
    if (!in_range(def->density, 1e-3, 1e6)) return "material.density must be in [1e-3, 1e6]";
    if (!(def->relaxation > 0.0f && def->relaxation < 2.0f)) return "material.relaxation must be in (0, 2)";
    if (!in_range(def->viscosity, 0.0, 1.0)) return "material.viscosity must be in [0, 1]";
    if (!in_range(def->volume_feedback, 0.0, 1.0)) return "material.volume_feedback must be in [0, 1]";
    if (!in_range(def->elasticity_ratio, 0.0, 1.0)) return "material.elasticity_ratio must be in [0, 1]";
    if (!in_enum(def->strain_policy, PBMPM_STRAIN_CLAMP, PBMPM_STRAIN_DELETE)) return "material.strain_policy is unknown";
    if (!in_range(def->strain_min, 1e-3, 1.0)) return "material.strain_min must be in [1e-3, 1]";
    if (!in_range(def->strain_max, 1.0, 1e4)) return "material.strain_max must be in [1, 1e4]";
    if (!in_range(def->condition_max, 10.0, 1e6)) return "material.condition_max must be in [10, 1e6]";
    if (!(def->rebound_max > 0.0f && def->rebound_max <= 10.0f)) return "material.rebound_max must be in (0, 10]";
    if (def->groups == 0) return "material.groups must not be 0";
    if (def->reserved != 0) return "material.reserved must be 0";
    const char *problem = modulus_problem(def);
    return problem ? problem : yield_problem(def);
}

/* Largest growth of ln J by which sand that came apart closes up before it bears pressure, about ln 3, by trial. Sand that was shaken or poured comes apart
 * further than that seldom; with less it keeps what it grew by, and with more lone particles, whose J is not that of a grid full of others, would
 * count as looser than they lie. */
static const float LOOSENESS_MAX = 1.1f;

static int32_t yield_of(pbmpm_material_kind kind)
{
    if (kind == PBMPM_SAND) return K_SAND;
    return kind == PBMPM_VISCO ? K_VISCO : K_NO_YIELD;
}

void materials_set(Materials *materials, uint32_t slot, const pbmpm_material_def *def)
{
    const bool liquid = def->kind == PBMPM_LIQUID;
    materials->def[slot] = *def;
    materials->kernel[slot] = (KernelMaterial){
        .kind = liquid ? K_LIQUID : K_SOLID,
        .relaxation = def->relaxation,
        .viscosity = liquid ? def->viscosity : 0.0f,
        .volume_feedback = material_flows(def) ? def->volume_feedback : 0.0f,
        .elasticity_ratio = def->elasticity_ratio,
        .strain_min = def->strain_min,
        .strain_max = def->strain_max,
        .condition_max = def->strain_policy == PBMPM_STRAIN_DELETE ? def->condition_max : 0.0f,
        .rebound_max = def->rebound_max,
        .growth_max = FLT_MAX, /* this and the next: the paper's solver sets them anew for each substep */
        .head2 = FLT_MAX,
        .inverse_density = 1.0f / def->density,
        .elastic_model = def->elastic_model == PBMPM_NEO_HOOKEAN ? K_NEO_HOOKEAN : K_FIXED_COROTATED,
        .yields = yield_of(def->kind),
        .cohesion = def->cohesion,
        .looseness = def->volume_correction ? LOOSENESS_MAX : 0.0f,
        .yield_strain = def->yield_strain,
    };
}

pbmpm_result materials_add(Materials *materials, const pbmpm_material_def *def, uint32_t generation, pbmpm_material_id *id)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (materials->generation[slot] != 0) continue;
        materials->generation[slot] = generation;
        materials_set(materials, slot, def);
        *id = (pbmpm_material_id){slot, generation};
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d materials", PBMPM_MAX_MATERIALS);
}

bool materials_want_volume(const Materials *materials, const Particles *particles)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (particles->of_material[slot] > 0 && material_flows(&materials->def[slot]) && materials->kernel[slot].volume_feedback > 0.0f) return true;
    return false;
}

bool materials_hold_visco(const Materials *materials, const Particles *particles)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (particles->of_material[slot] > 0 && materials->kernel[slot].yields == K_VISCO) return true;
    return false;
}

double materials_lightest(const Materials *materials, const Particles *particles)
{
    double lightest = INFINITY;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (particles->of_material[slot] > 0 && !material_is_solid(materials, slot)) lightest = fmin(lightest, (double)materials->def[slot].density);
    return lightest < INFINITY ? lightest : 0.0;
}

double materials_density_contrast(const Materials *materials, const Particles *particles)
{
    double lightest = INFINITY, densest = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (particles->of_material[slot] == 0 || material_is_solid(materials, slot)) continue;
        lightest = fmin(lightest, (double)materials->def[slot].density);
        densest = fmax(densest, (double)materials->def[slot].density);
    }
    return densest > 0.0 ? densest / lightest : 1.0;
}

bool materials_want_modulus(const Materials *materials)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (materials->generation[slot] != 0 && materials->def[slot].kind == PBMPM_LIQUID && materials->def[slot].bulk_modulus == 0.0f)
            return true;
    return false;
}
