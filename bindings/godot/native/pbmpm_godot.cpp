/* The native class PbmpmNative of the Godot plugin: a world in Godot's frame loop. The nodes in addons/pbmpm are made of it.
 *
 * Definitions are dictionaries, whose fields are named as in pbmpm.h. Vectors are Vector3, turns are Quat, and identifiers are whole numbers. What fails is told by
 * Godot's error list, and the method returns null. */
#include "values.hpp"

#include <pbmpm_engine/points.hpp>
#include <pbmpm_engine/simulation.hpp>

#include <memory>
#include <unordered_map>

namespace engine = pbmpm::engine;
using namespace godot_values;
using gdnative::variant;

namespace {

variant fails(const char *method, const std::string &why)
{
    gdnative::print_error(("pbmpm: " + why).c_str(), method, "PbmpmNative", 0);
    return nothing();
}

constexpr int floats_per_instance = 16; /* a 3 x 4 matrix by rows, and a colour */

/* What MultiMesh.set_as_bulk_array() takes: Godot's own array, which is kept and written anew in each frame. */
class instances {
public:
    explicit instances(std::uint32_t capacity)
    {
        gdnative::pool_reals_new(&pool_);
        gdnative::pool_reals_resize(&pool_, static_cast<int>(capacity) * floats_per_instance);
        /* Godot looks at all of it for the bounds of what it draws. */
        gdnative::access *access = gdnative::pool_reals_write(&pool_);
        std::memset(gdnative::pool_reals_write_at(access), 0, std::size_t{capacity} * floats_per_instance * sizeof(float));
        gdnative::pool_reals_written(access);
    }
    ~instances() { gdnative::pool_reals_destroy(&pool_); }
    instances(const instances &) = delete;
    instances &operator=(const instances &) = delete;

    template <class Colours> variant write(pbmpm::span<const engine::point> points, float size, const Colours &colours)
    {
        gdnative::access *access = gdnative::pool_reals_write(&pool_);
        float *to = gdnative::pool_reals_write_at(access);
        for (const engine::point &point : points) {
            const auto colour = colours.find(point.material);
            const pbmpm::vector3 shade = colour == colours.end() ? pbmpm::vector3{1, 1, 1} : colour->second;
            const float instance[floats_per_instance] = {size, 0, 0, point.position[0], 0, size, 0, point.position[1],
                                                         0, 0, size, point.position[2], shade[0], shade[1], shade[2], 1};
            std::memcpy(to, instance, sizeof instance);
            to += floats_per_instance;
        }
        gdnative::pool_reals_written(access);
        variant it;
        gdnative::variant_new_pool_reals(&it, &pool_);
        return it;
    }

private:
    gdnative::pool_reals pool_;
};

class native {
public:
    variant create(variant **a)
    {
        engine::options wanted;
        fields f(a[0]);
        f.read("cell_size", wanted.world.cell_size);
        f.read("particle_capacity", wanted.world.particle_capacity);
        f.read("thread_count", wanted.world.thread_count);
        f.read("domain_enabled", wanted.world.domain_enabled);
        f.read("domain_min", wanted.world.domain_min);
        f.read("domain_max", wanted.world.domain_max);
        f.read("domain_friction", wanted.world.domain_friction);
        f.read("gravity", wanted.settings.gravity);
        f.read("substeps", wanted.settings.substeps);
        f.read("iterations", wanted.settings.iterations);
        f.read("sleeping", wanted.settings.sleeping);
        f.read_word("solver", {"paper", "dual", "primal", "explicit", "convergent"}, wanted.settings.solver);
        f.read("dt", wanted.dt);
        f.read("most_steps", wanted.most_steps);
        f.read("background", wanted.background);
        if (!f.complaint().empty()) return fails("create", f.complaint());
        auto made = engine::simulation::create(wanted);
        if (!made) return fails("create", made.error().message);
        simulation_ = std::make_unique<engine::simulation>(std::move(*made));
        points_ = std::make_unique<engine::points>(engine::godot, wanted.world.particle_capacity);
        instances_ = std::make_unique<instances>(wanted.world.particle_capacity);
        colours_.clear();
        return from(true);
    }
    variant set_kill_bounds(variant **a)
    {
        return edit("set_kill_bounds", [&](const pbmpm::world_ref &world) {
            pbmpm::kill_bounds bounds;
            const pbmpm::vector3 low = vector_of(a[0]), high = vector_of(a[1]);
            bounds.enabled = 1;
            std::memcpy(bounds.low, low.data(), sizeof bounds.low);
            std::memcpy(bounds.high, high.data(), sizeof bounds.high);
            return world.set_kill_bounds(bounds);
        });
    }
    variant add_material(variant **a)
    {
        pbmpm::material_def def;
        float colour[3] = {1, 1, 1};
        fields f(a[0]);
        f.read_word("kind", {"liquid", "elastic", "sand", "visco"}, def.kind);
        f.read("density", def.density);
        f.read("kinematic_viscosity", def.kinematic_viscosity);
        f.read("young_modulus", def.young_modulus);
        f.read("poisson_ratio", def.poisson_ratio);
        f.read("friction_angle", def.friction_angle);
        f.read("cohesion", def.cohesion);
        f.read("yield_strain", def.yield_strain);
        f.read("flow_rate", def.flow_rate);
        f.read("colour", colour);
        if (!f.complaint().empty()) return fails("add_material", f.complaint());
        return edit("add_material", [&](const pbmpm::world_ref &world) {
            const auto material = world.material_create(def);
            if (material) colours_[material->index] = {colour[0], colour[1], colour[2]};
            return material;
        });
    }
    variant fill(variant **a)
    {
        pbmpm::fill_def def;
        pbmpm::shape shape;
        fields f(a[0]);
        f.read_id("material", def.material);
        f.read("particles_per_axis", def.particles_per_axis);
        f.read("jitter", def.jitter);
        f.read("velocity", def.velocity);
        f.read("seed", def.seed);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("fill", f.complaint());
        return edit("fill", [&](const pbmpm::world_ref &world) { return world.particles_fill(def, shape); });
    }
    variant add_collider(variant **a)
    {
        pbmpm::collider_def def;
        pbmpm::shape shape;
        fields f(a[0]);
        f.read_word("friction", {"coulomb", "stick", "slip"}, def.friction);
        f.read("friction_coefficient", def.friction_coefficient);
        f.read("kinematic", def.kinematic);
        f.read("measures_impulse", def.measures_impulse);
        f.read("sensor", def.sensor);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("add_collider", f.complaint());
        return edit("add_collider", [&](const pbmpm::world_ref &world) { return world.collider_create(def, shape); });
    }
    variant remove_collider(variant **a)
    {
        return edit("remove_collider", [&](const pbmpm::world_ref &world) {
            const auto collider = id_of<pbmpm_collider_id>(gdnative::variant_as_int(a[0]));
            simulation_->leave(collider);
            return world.collider_destroy(collider);
        });
    }
    variant add_emitter(variant **a)
    {
        pbmpm::emitter_def def;
        pbmpm::shape shape;
        fields f(a[0]);
        read_emitter(f, def);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("add_emitter", f.complaint());
        return edit("add_emitter", [&](const pbmpm::world_ref &world) { return world.emitter_create(def, shape); });
    }
    variant set_emitter(variant **a)
    {
        return edit("set_emitter", [&](const pbmpm::world_ref &world) -> pbmpm::expected<void> {
            const auto emitter = id_of<pbmpm_emitter_id>(gdnative::variant_as_int(a[0]));
            auto now = world.emitter_get(emitter);
            if (!now) return now.error();
            fields f(a[1]);
            read_emitter(f, now->def);
            if (!f.complaint().empty()) return refused(f);
            return world.emitter_set(emitter, &now->def);
        });
    }
    variant add_drain(variant **a)
    {
        pbmpm::drain_def def;
        pbmpm::shape shape;
        fields f(a[0]);
        f.read_id("material", def.material);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("add_drain", f.complaint());
        return edit("add_drain", [&](const pbmpm::world_ref &world) { return world.drain_create(def, shape); });
    }
    variant add_force(variant **a)
    {
        pbmpm::force_def def;
        pbmpm::shape shape;
        fields f(a[0]);
        read_force(f, def);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("add_force", f.complaint());
        return edit("add_force", [&](const pbmpm::world_ref &world) { return world.force_create(def, shape); });
    }
    /* Fields that are not there stay as they are. */
    variant set_force(variant **a)
    {
        return edit("set_force", [&](const pbmpm::world_ref &world) -> pbmpm::expected<void> {
            const auto force = id_of<pbmpm_force_id>(gdnative::variant_as_int(a[0]));
            auto now = world.force_get(force);
            if (!now) return now.error();
            fields f(a[1]);
            read_force(f, now->def);
            read_shape(f, now->shape);
            if (!f.complaint().empty()) return refused(f);
            return world.force_set(force, &now->def, &now->shape);
        });
    }
    /* Corners of triangles, three by three, as Mesh.get_faces() has them; and the resolution. */
    variant bake_mesh(variant **a)
    {
        const std::vector<float> corners = vectors_of(a[0]);
        std::vector<std::uint32_t> elements(corners.size() / 3);
        for (std::size_t i = 0; i < elements.size(); i++) elements[i] = static_cast<std::uint32_t>(i);
        pbmpm::mesh_def def;
        def.vertices = corners.data();
        def.elements = elements.data();
        def.vertex_count = static_cast<std::uint32_t>(elements.size());
        def.element_count = def.vertex_count / 3;
        def.resolution = static_cast<std::int32_t>(gdnative::variant_as_int(a[1]));
        return load("bake_mesh", [&](pbmpm::span<std::byte> buffer) { return pbmpm::bake_mesh(def, buffer); });
    }
    /* Heights row by row along x, how many in a row, their spacing and the thickness below the lowest. */
    variant bake_heights(variant **a)
    {
        const std::vector<float> heights = reals_of(a[0]);
        const auto columns = static_cast<std::uint32_t>(gdnative::variant_as_int(a[1]));
        if (columns < 2 || heights.size() % columns != 0) return fails("bake_heights", "the heights do not fill their rows");
        pbmpm::heights_def def;
        def.heights = heights.data();
        def.count[0] = columns;
        def.count[1] = static_cast<std::uint32_t>(heights.size()) / columns;
        def.spacing[0] = def.spacing[1] = static_cast<float>(gdnative::variant_as_real(a[2]));
        def.thickness = static_cast<float>(gdnative::variant_as_real(a[3]));
        return load("bake_heights", [&](pbmpm::span<std::byte> buffer) { return pbmpm::bake_heights(def, buffer); });
    }
    /* A collider, the mass of its body, and its centre of mass. */
    variant couple(variant **a)
    {
        if (!simulation_) return fails("couple", no_world);
        const auto collider = id_of<pbmpm_collider_id>(gdnative::variant_as_int(a[0]));
        const auto body = simulation_->add_body(engine::body(collider, static_cast<float>(gdnative::variant_as_real(a[1])), vector_of(a[2])));
        return body ? from(static_cast<std::int64_t>(*body)) : fails("couple", body.error().message);
    }
    /* A body's number; its collider goes, too. */
    variant uncouple(variant **a)
    {
        if (!body_of(a[0])) return fails("uncouple", no_body);
        const auto gone = simulation_->remove_body(static_cast<std::size_t>(gdnative::variant_as_int(a[0])));
        return gone ? from(true) : fails("uncouple", gone.error().message);
    }
    /* A body's number, then position, turn, velocity and angular velocity. */
    variant set_motion(variant **a)
    {
        engine::body *body = body_of(a[0]);
        if (!body) return fails("set_motion", no_body);
        body->set_motion({vector_of(a[1]), quaternion_of(a[2]), vector_of(a[3]), vector_of(a[4])});
        return from(true);
    }
    variant take_push(variant **a)
    {
        engine::body *body = body_of(a[0]);
        if (!body) return fails("take_push", no_body);
        const engine::push push = body->take_push();
        answer it;
        it.set("linear", push.linear);
        it.set("angular", push.angular);
        return it.value();
    }
    variant follow_collider(variant **a) { return follow<pbmpm_collider_id>("follow_collider", a); }
    variant follow_emitter(variant **a) { return follow<pbmpm_emitter_id>("follow_emitter", a); }
    variant frame(variant **a)
    {
        if (!simulation_) return fails("frame", no_world);
        const auto steps = simulation_->frame(gdnative::variant_as_real(a[0]));
        return steps ? from(static_cast<std::int64_t>(*steps)) : fails("frame", steps.error().message);
    }
    /* The particles for MultiMesh.set_as_bulk_array(); how large to draw a mesh of the size of 1. */
    variant draw(variant **a)
    {
        if (!simulation_) return fails("draw", no_world);
        const auto points = points_->copy(simulation_->reading(), simulation_->clock().alpha());
        if (!points) return fails("draw", points.error().message);
        drawn_ = static_cast<std::int64_t>(points->size());
        return instances_->write(*points, static_cast<float>(gdnative::variant_as_real(a[0])), colours_);
    }
    /* How many the last draw() wrote. */
    variant drawn(variant **) { return from(drawn_); }
    /* How many particles are in a shape. */
    variant count_in(variant **a)
    {
        pbmpm::shape shape;
        fields f(a[0]);
        read_shape(f, shape);
        if (!f.complaint().empty()) return fails("count_in", f.complaint());
        return edit("count_in", [&](const pbmpm::world_ref &world) { return world.query_shape(shape, {}); });
    }
    variant figures(variant **)
    {
        if (!simulation_) return fails("figures", no_world);
        const auto stats = simulation_->reading().get_step_stats();
        if (!stats) return fails("figures", stats.error().message);
        answer it;
        it.set("particles", std::int64_t{stats->particle_count});
        it.set("step_ms", double{stats->ms_total});
        it.set("steps", static_cast<std::int64_t>(stats->step_count));
        it.set("predicted_error", double{stats->predicted_error});
        it.set("lost_seconds", simulation_->clock().lost());
        it.set("debt_seconds", simulation_->clock().debt());
        return it.value();
    }
    /* One line for each advice of the library. */
    variant advice(variant **)
    {
        if (!simulation_) return fails("advice", no_world);
        const auto world = simulation_->editing();
        if (!world) return fails("advice", world.error().message);
        std::array<pbmpm_advice, 16> list{};
        const auto count = world->advice(static_cast<float>(simulation_->clock().dt()), list);
        if (!count) return fails("advice", count.error().message);
        std::string lines;
        for (std::size_t i = 0; i < list.size() && i < *count; i++) lines += std::string(pbmpm::advice_name(list[i].code)) + ": " + list[i].text + "\n";
        return from(lines.c_str());
    }
    variant hash(variant **)
    {
        return edit("hash", [](const pbmpm::world_ref &world) -> pbmpm::expected<std::int64_t> {
            const auto hash = world.hash();
            if (!hash) return hash.error();
            return static_cast<std::int64_t>(*hash);
        });
    }

private:
    static constexpr const char *no_world = "create() comes first", *no_body = "there is no such body";

    static void read_shape(fields &f, pbmpm::shape &shape) { read_shape(f, static_cast<pbmpm_shape &>(shape)); }
    static void read_shape(fields &f, pbmpm_shape &shape)
    {
        f.read_word("shape", {"plane", "box", "sphere", "capsule", "baked"}, shape.kind);
        f.read("position", shape.position);
        f.read("rotation", shape.rotation);
        f.read("half_extents", shape.half_extents);
        f.read("half_length", shape.half_extents[0]);
        f.read("radius", shape.radius);
        f.read("normal", shape.normal);
        f.read_id("baked", shape.baked);
    }
    static void read_emitter(fields &f, pbmpm_emitter_def &def)
    {
        f.read_id("material", def.material);
        f.read_word("region", {"volume", "disc"}, def.region);
        f.read("enabled", def.enabled);
        f.read("rate", def.rate);
        f.read("speed", def.speed);
        f.read("direction", def.direction);
        f.read("spread", def.spread);
        f.read("fill_limit", def.fill_limit);
        f.read("particles_per_axis", def.particles_per_axis);
    }
    static void read_force(fields &f, pbmpm_force_def &def)
    {
        f.read_word("kind", {"uniform", "radial", "vortex", "drag", "grab"}, def.kind);
        f.read_word("falloff", {"none", "linear", "smooth", "inverse_square"}, def.falloff);
        f.read("enabled", def.enabled);
        f.read("everywhere", def.everywhere);
        f.read("range", def.range);
        f.read("strength", def.strength);
        f.read("direction", def.direction);
        f.read("velocity", def.velocity);
        f.read("spin", def.spin);
    }

    /* The text has to live until the failure is told. */
    pbmpm::failure refused(fields &f)
    {
        complaint_ = f.complaint();
        return {PBMPM_ERROR_INVALID_ARGUMENT, complaint_.c_str()};
    }
    static variant value_of(std::uint32_t value) { return from(std::int64_t{value}); }
    static variant value_of(std::int64_t value) { return from(value); }
    template <class Id, class = std::enable_if_t<pbmpm::detail::is_id<Id>::value>> static variant value_of(Id id) { return from(number_of(id)); }

    template <class Action> variant edit(const char *method, Action action)
    {
        if (!simulation_) return fails(method, no_world);
        const auto world = simulation_->editing();
        if (!world) return fails(method, world.error().message);
        const auto result = action(*world);
        if (!result) return fails(method, result.error().message);
        if constexpr (std::is_same_v<std::decay_t<decltype(result)>, pbmpm::expected<void>>)
            return from(true);
        else
            return value_of(*result);
    }
    template <class Bake> variant load(const char *method, Bake bake)
    {
        const auto size = bake({});
        if (!size) return fails(method, size.error().message);
        std::vector<std::byte> bytes(static_cast<std::size_t>(*size));
        if (const auto baked = bake(bytes); !baked) return fails(method, baked.error().message);
        return edit(method, [&](const pbmpm::world_ref &world) { return world.baked_create(bytes); });
    }
    template <class Id> variant follow(const char *method, variant **a)
    {
        if (!simulation_) return fails(method, no_world);
        simulation_->follow(id_of<Id>(gdnative::variant_as_int(a[0])), vector_of(a[1]), quaternion_of(a[2]));
        return from(true);
    }
    engine::body *body_of(const variant *number)
    {
        const std::int64_t index = gdnative::variant_as_int(number);
        if (!simulation_ || index < 0 || static_cast<std::size_t>(index) >= simulation_->body_count()) return nullptr;
        return &simulation_->body_at(static_cast<std::size_t>(index));
    }

    std::unique_ptr<engine::simulation> simulation_;
    std::unique_ptr<engine::points> points_;
    std::unique_ptr<instances> instances_;
    std::unordered_map<std::uint32_t, pbmpm::vector3> colours_; /* by the index of the material */
    std::int64_t drawn_ = 0;
    std::string complaint_;
};

struct method {
    const char *name;
    int arguments;
    variant (native::*call)(variant **);
};
const method methods[] = {
    {"create", 1, &native::create},
    {"set_kill_bounds", 2, &native::set_kill_bounds},
    {"add_material", 1, &native::add_material},
    {"fill", 1, &native::fill},
    {"add_collider", 1, &native::add_collider},
    {"remove_collider", 1, &native::remove_collider},
    {"add_emitter", 1, &native::add_emitter},
    {"set_emitter", 2, &native::set_emitter},
    {"add_drain", 1, &native::add_drain},
    {"add_force", 1, &native::add_force},
    {"set_force", 2, &native::set_force},
    {"bake_mesh", 2, &native::bake_mesh},
    {"bake_heights", 4, &native::bake_heights},
    {"couple", 3, &native::couple},
    {"uncouple", 1, &native::uncouple},
    {"set_motion", 5, &native::set_motion},
    {"take_push", 1, &native::take_push},
    {"follow_collider", 3, &native::follow_collider},
    {"follow_emitter", 3, &native::follow_emitter},
    {"frame", 1, &native::frame},
    {"draw", 1, &native::draw},
    {"drawn", 0, &native::drawn},
    {"count_in", 1, &native::count_in},
    {"figures", 0, &native::figures},
    {"advice", 0, &native::advice},
    {"hash", 0, &native::hash},
};

variant call(gdnative::object *, void *data, void *user, int count, variant **arguments)
{
    const auto *it = static_cast<const method *>(data);
    if (count != it->arguments) return fails(it->name, "it takes " + std::to_string(it->arguments) + " arguments");
    return (static_cast<native *>(user)->*it->call)(arguments);
}

} // namespace

extern "C" {

/* Names that Godot looks for. */
__attribute__((visibility("default"))) void pbmpm_gdnative_init(gdnative::init_options *options)
{
    if (gdnative::begin(*options)) return;
    options->report_loading_error(options->library, "pbmpm needs Godot 3.2 or a later 3.x");
}
__attribute__((visibility("default"))) void pbmpm_gdnative_terminate(void *) { static_cast<void>(pbmpm::shutdown()); }
__attribute__((visibility("default"))) void pbmpm_nativescript_init(void *handle)
{
    if (!gdnative::nativescript) return;
    gdnative::register_class(handle, "PbmpmNative", "Reference", gdnative::create_function{[](gdnative::object *, void *) -> void * { return new native; }, nullptr, nullptr},
                             gdnative::destroy_function{[](gdnative::object *, void *, void *user) { delete static_cast<native *>(user); }, nullptr, nullptr});
    for (const method &it : methods)
        gdnative::register_method(handle, "PbmpmNative", it.name, gdnative::method_attributes{0}, gdnative::method_function{call, const_cast<method *>(&it), nullptr});
}
}
