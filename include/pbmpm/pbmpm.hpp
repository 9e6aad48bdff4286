/* pbmpm for C++17: all of pbmpm.h, with worlds that destroy themselves, results that carry a value, and spans. Header only.
 * It throws nothing, needs no RTTI and takes no memory.
 *
 * Names follow C's. A call on a world, pbmpm_collider_move(world, ...), is world.collider_move(...); pbmpm_world_step(world, dt)
 * is world.step(dt). Other calls are functions of the namespace: pbmpm_bake_mesh() is pbmpm::bake_mesh(). What a call does, its
 * errors and its threads stand at C's function.
 * Enumerations, structures and identifiers are C's. Each kind of identifier is a type of its own, so none is taken for another.
 *
 *     pbmpm::world_def tank; // has its defaults
 *     auto world = pbmpm::world::create(tank);
 *     if (!world) return complain(world.error().message);
 *     if (auto stepped = world->step(1.0f / 60); !stepped) return complain(stepped.error().message);
 */
#ifndef PBMPM_HPP
#define PBMPM_HPP

#include "pbmpm.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

namespace pbmpm {

/** Elements that lie side by side and belong to somebody else; made from arrays and from containers that have data() and size(). */
template <class T> class span {
public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <class Container, class Element = std::remove_pointer_t<decltype(std::data(std::declval<Container &>()))>,
              class = std::enable_if_t<std::is_convertible_v<Element (*)[], T (*)[]> && !std::is_same_v<std::decay_t<Container>, span>>>
    constexpr span(Container &&container) noexcept : data_(std::data(container)), size_(std::size(container))
    {
    }
    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const noexcept { return assert(index < size_), data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/** Elements as bytes, for particles_copy(), snapshots and baked solids. */
template <class Container> auto as_writable_bytes(Container &container) noexcept
{
    using element = std::remove_pointer_t<decltype(std::data(container))>;
    static_assert(std::is_trivially_copyable_v<element>);
    return span<std::byte>(reinterpret_cast<std::byte *>(std::data(container)), std::size(container) * sizeof(element));
}
template <class Container> auto as_bytes(const Container &container) noexcept
{
    using element = std::remove_pointer_t<decltype(std::data(container))>;
    static_assert(std::is_trivially_copyable_v<element>);
    return span<const std::byte>(reinterpret_cast<const std::byte *>(std::data(container)), std::size(container) * sizeof(element));
}

/** Why a call failed. */
struct failure {
    pbmpm_result code;
    const char *message;      /**< valid until the next call that fails on this thread; never null */
    std::uint64_t needed = 0; /**< with CAPACITY: how many particles, points or bytes are needed; else 0 */

    const char *name() const noexcept { return pbmpm_result_name(code); }
    /** Writes name and message to standard error, and calls abort(). For programs that cannot go on. */
    [[noreturn]] void end() const noexcept
    {
        std::fprintf(stderr, "%s: %s\n", name(), message);
        std::abort();
    }
};

/** A value, or why there is none. */
template <class T> class [[nodiscard]] expected {
public:
    expected(T value) noexcept : value_(std::move(value)) {}
    expected(failure why) noexcept : failure_(why) {}

    bool has_value() const noexcept { return value_.has_value(); }
    explicit operator bool() const noexcept { return has_value(); }
    T &operator*() & noexcept { return assert(value_), *value_; }
    const T &operator*() const & noexcept { return assert(value_), *value_; }
    T &&operator*() && noexcept { return assert(value_), *std::move(value_); }
    T *operator->() noexcept { return &**this; }
    const T *operator->() const noexcept { return &**this; }
    /** With a value its code is PBMPM_OK. */
    const failure &error() const noexcept { return failure_; }
    T value_or(T other) && noexcept { return value_ ? *std::move(value_) : std::move(other); }
    /** The value. Without one it writes the failure to standard error and calls abort(), see failure::end(). */
    T &value() & noexcept
    {
        if (!value_) failure_.end();
        return *value_;
    }
    T &&value() && noexcept { return std::move(value()); }

private:
    std::optional<T> value_;
    failure failure_{PBMPM_OK, ""};
};

/** That a call was done, or why it was not. */
template <> class [[nodiscard]] expected<void> {
public:
    expected() noexcept = default;
    expected(failure why) noexcept : failure_(why) {}

    bool has_value() const noexcept { return failure_.code == PBMPM_OK; }
    explicit operator bool() const noexcept { return has_value(); }
    const failure &error() const noexcept { return failure_; }
    /** Without success it writes the failure to standard error and calls abort(), see failure::end(). */
    void value() const noexcept
    {
        if (!has_value()) failure_.end();
    }

private:
    failure failure_{PBMPM_OK, ""};
};

namespace detail {

template <class T> struct is_id : std::false_type {};
template <> struct is_id<pbmpm_world_id> : std::true_type {};
template <> struct is_id<pbmpm_material_id> : std::true_type {};
template <> struct is_id<pbmpm_collider_id> : std::true_type {};
template <> struct is_id<pbmpm_emitter_id> : std::true_type {};
template <> struct is_id<pbmpm_drain_id> : std::true_type {};
template <> struct is_id<pbmpm_force_id> : std::true_type {};
template <> struct is_id<pbmpm_baked_id> : std::true_type {};
template <> struct is_id<pbmpm_particle_id> : std::true_type {};

inline failure why(pbmpm_result code, std::uint64_t needed = 0) noexcept
{
    return {code, pbmpm_last_error(), code == PBMPM_ERROR_CAPACITY ? needed : 0};
}
inline failure refused(const char *message) noexcept { return {PBMPM_ERROR_INVALID_ARGUMENT, message}; }

inline expected<void> done(pbmpm_result result) noexcept
{
    if (result != PBMPM_OK) return why(result);
    return {};
}
/* By reference: arguments are evaluated in any order, and the call beside it writes the value. */
template <class T> expected<T> got(pbmpm_result result, T &value) noexcept
{
    if (result != PBMPM_OK) return why(result);
    return std::move(value);
}
template <class T> expected<T> got_or_needed(pbmpm_result result, T &value) noexcept
{
    if (result != PBMPM_OK) return why(result, value);
    return value;
}
inline expected<bool> answer(pbmpm_result result, const std::int32_t &value) noexcept
{
    if (result != PBMPM_OK) return why(result);
    return value != 0;
}

/* As many as the library can count; it has no array that is longer. */
template <class T> std::uint32_t room(span<T> elements) noexcept
{
    return elements.size() > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(elements.size());
}
/* An array of no elements may have an address, and C takes an address for room. */
template <class T> T *or_null(span<T> elements) noexcept { return elements.empty() ? nullptr : elements.data(); }
/* Where null would be refused before the room is looked at. */
inline void *not_null(span<std::byte> buffer) noexcept
{
    static std::byte none[1];
    return buffer.empty() ? none : buffer.data();
}
template <class T> bool countable(span<T> elements) noexcept { return elements.size() <= UINT32_MAX; }

template <class T> T sized() noexcept
{
    T it{};
    it.size = static_cast<std::uint32_t>(sizeof it);
    return it;
}
/* Of an array the first element tells the size. */
template <class T> T *sized(span<T> elements) noexcept
{
    if (!elements.empty()) elements[0].size = static_cast<std::uint32_t>(sizeof(T));
    return elements.data();
}

inline pbmpm_result fill_in(pbmpm_world_def &it) noexcept { return pbmpm_world_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_settings &it) noexcept { return pbmpm_settings_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_material_def &it) noexcept { return pbmpm_material_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_shape &it) noexcept { return pbmpm_shape_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_mesh_def &it) noexcept { return pbmpm_mesh_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_heights_def &it) noexcept { return pbmpm_heights_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_particles_def &it) noexcept { return pbmpm_particles_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_fill_def &it) noexcept { return pbmpm_fill_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_copy_def &it) noexcept { return pbmpm_copy_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_surface_def &it) noexcept { return pbmpm_surface_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_points_def &it) noexcept { return pbmpm_points_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_collider_def &it) noexcept { return pbmpm_collider_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_emitter_def &it) noexcept { return pbmpm_emitter_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_drain_def &it) noexcept { return pbmpm_drain_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_kill_bounds &it) noexcept { return pbmpm_kill_bounds_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_force_def &it) noexcept { return pbmpm_force_def_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_ray &it) noexcept { return pbmpm_ray_init(&it, sizeof it); }
inline pbmpm_result fill_in(pbmpm_rigid_def &it) noexcept { return pbmpm_rigid_def_init(&it, sizeof it); }

/* A structure that begins with the library's defaults. One whose size the library does not know stays 0, and the call that takes it is UNSUPPORTED. */
template <class Structure> struct filled_in : Structure {
    filled_in() noexcept : Structure{} { static_cast<void>(fill_in(*this)); }
};

/* A structure of which the caller sets all members but the size. */
template <class Structure> struct with_size : Structure {
    with_size() noexcept : Structure(sized<Structure>()) {}
};

} // namespace detail

/** Whether an identifier names nothing. */
template <class Id, class = std::enable_if_t<detail::is_id<Id>::value>> constexpr bool is_null(Id id) noexcept { return id.index == 0 && id.generation == 0; }

using world_def = detail::filled_in<pbmpm_world_def>;
using settings = detail::filled_in<pbmpm_settings>;
using material_def = detail::filled_in<pbmpm_material_def>;
using shape = detail::filled_in<pbmpm_shape>;
using mesh_def = detail::filled_in<pbmpm_mesh_def>;
using heights_def = detail::filled_in<pbmpm_heights_def>;
using particles_def = detail::filled_in<pbmpm_particles_def>;
using fill_def = detail::filled_in<pbmpm_fill_def>;
using copy_def = detail::filled_in<pbmpm_copy_def>;
using surface_def = detail::filled_in<pbmpm_surface_def>;
using points_def = detail::filled_in<pbmpm_points_def>;
using collider_def = detail::filled_in<pbmpm_collider_def>;
using emitter_def = detail::filled_in<pbmpm_emitter_def>;
using drain_def = detail::filled_in<pbmpm_drain_def>;
using kill_bounds = detail::filled_in<pbmpm_kill_bounds>;
using force_def = detail::filled_in<pbmpm_force_def>;
using ray = detail::filled_in<pbmpm_ray>;
using rigid_def = detail::filled_in<pbmpm_rigid_def>;
using allocator = detail::with_size<pbmpm_allocator>;
using task_hooks = detail::with_size<pbmpm_task_hooks>;

using vector3 = std::array<float, 3>;
using quaternion = std::array<float, 4>;

/** A definition, and where the object is. */
template <class Definition> struct placed {
    Definition def;
    pbmpm_shape shape;
};

struct event_count {
    std::uint32_t kept;
    std::uint32_t missed; /**< that the world had no room to keep */
};

struct snapshot_bytes {
    std::uint64_t all;
    std::uint32_t per_particle;
};

/** A field of all particles, see pbmpm_view. */
struct view : pbmpm_view {
    /** A component of a particle; T is float, std::uint32_t or std::int32_t. */
    template <class T> T at(std::uint32_t particle, std::uint32_t component = 0) const noexcept
    {
        static_assert(std::is_arithmetic_v<T> && sizeof(T) == 4);
        assert(particle < count && component < components);
        T value;
        std::memcpy(&value, static_cast<const char *>(data) + particle * stride + std::uint64_t{component} * component_stride, sizeof value);
        return value;
    }
};

/** A world that belongs to somebody else; copies name the same world. A name of none is refused by every call with INVALID_ID. */
class world_ref {
public:
    constexpr world_ref() noexcept = default;
    constexpr explicit world_ref(pbmpm_world_id id) noexcept : id_(id) {}
    constexpr pbmpm_world_id id() const noexcept { return id_; }

    /* The world (world.h). */
    expected<bool> is_valid() const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_world_is_valid(id_, &valid), valid);
    }
    expected<pbmpm_world_def> get_def() const noexcept
    {
        auto def = detail::sized<pbmpm_world_def>();
        return detail::got(pbmpm_world_get_def(id_, &def), def);
    }
    expected<pbmpm_settings> get_settings() const noexcept
    {
        auto now = detail::sized<pbmpm_settings>();
        return detail::got(pbmpm_world_get_settings(id_, &now), now);
    }
    expected<void> set_settings(const pbmpm_settings &wanted) const noexcept { return detail::done(pbmpm_world_set_settings(id_, &wanted)); }
    expected<void> step(float dt) const noexcept { return detail::done(pbmpm_world_step(id_, dt)); }
    /** By how much it moved. */
    expected<std::array<double, 3>> shift_origin(const std::array<double, 3> &wanted) const noexcept
    {
        std::array<double, 3> moved{};
        return detail::got(pbmpm_world_shift_origin(id_, wanted.data(), moved.data()), moved);
    }
    expected<std::uint64_t> generation() const noexcept
    {
        std::uint64_t generation = 0;
        return detail::got(pbmpm_world_generation(id_, &generation), generation);
    }
    expected<std::uint64_t> hash() const noexcept
    {
        std::uint64_t hash = 0;
        return detail::got(pbmpm_world_hash(id_, &hash), hash);
    }

    /* Steps in the background (async.h). */
    expected<void> publish(span<const pbmpm_field> fields) const noexcept
    {
        return detail::done(pbmpm_world_publish(id_, fields.data(), detail::room(fields)));
    }
    expected<void> step_begin(float dt) const noexcept { return detail::done(pbmpm_world_step_begin(id_, dt)); }
    expected<void> step_end(bool wait = true) const noexcept { return detail::done(pbmpm_world_step_end(id_, wait)); }
    expected<bool> step_done() const noexcept
    {
        std::int32_t is_done = 0;
        return detail::answer(pbmpm_world_step_done(id_, &is_done), is_done);
    }

    /* What a step came to (stats.h), advice (advice.h), lines to draw (debug.h). Of a list as much is written as there is room for; the value is how many
     * there are. */
    expected<pbmpm_stats> get_stats() const noexcept
    {
        auto stats = detail::sized<pbmpm_stats>();
        return detail::got(pbmpm_world_get_stats(id_, &stats), stats);
    }
    expected<pbmpm_stats> get_step_stats() const noexcept
    {
        auto stats = detail::sized<pbmpm_stats>();
        return detail::got(pbmpm_world_get_step_stats(id_, &stats), stats);
    }
    expected<event_count> events(span<pbmpm_event> events) const noexcept
    {
        event_count count{};
        return detail::got(pbmpm_world_events(id_, detail::sized(events), detail::room(events), &count.kept, &count.missed), count);
    }
    expected<std::uint32_t> advice(float dt, span<pbmpm_advice> array) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_advice(id_, dt, detail::sized(array), detail::room(array), &count), count);
    }
    expected<std::uint32_t> debug_lines(std::uint32_t parts, span<pbmpm_line> lines) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_debug_lines(id_, parts, lines.data(), detail::room(lines), &count), count);
    }

    /* Materials (material.h). */
    expected<pbmpm_material_id> material_create(const pbmpm_material_def &def) const noexcept
    {
        pbmpm_material_id material{};
        return detail::got(pbmpm_material_create(id_, &def, &material), material);
    }
    expected<pbmpm_material_def> material_get(pbmpm_material_id material) const noexcept
    {
        auto def = detail::sized<pbmpm_material_def>();
        return detail::got(pbmpm_material_get(id_, material, &def), def);
    }
    expected<void> material_set(pbmpm_material_id material, const pbmpm_material_def &def) const noexcept
    {
        return detail::done(pbmpm_material_set(id_, material, &def));
    }
    expected<pbmpm_effective> material_effective(pbmpm_material_id material, float dt) const noexcept
    {
        auto effective = detail::sized<pbmpm_effective>();
        return detail::got(pbmpm_material_effective(id_, material, dt, &effective), effective);
    }
    expected<void> material_destroy(pbmpm_material_id material) const noexcept { return detail::done(pbmpm_material_destroy(id_, material)); }
    expected<bool> material_is_valid(pbmpm_material_id material) const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_material_is_valid(id_, material, &valid), valid);
    }
    expected<std::uint32_t> get_materials(span<pbmpm_material_id> materials) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_get_materials(id_, materials.data(), detail::room(materials), &count), count);
    }

    /* Particles (particles.h). */
    /** `ids`: empty, or room for def.count. */
    expected<void> particles_add(const pbmpm_particles_def &def, span<pbmpm_particle_id> ids = {}) const noexcept
    {
        if (!ids.empty() && ids.size() < def.count) return detail::refused("particles_add: there is room for fewer identifiers than particles");
        return detail::done(pbmpm_particles_add(id_, &def, detail::or_null(ids)));
    }
    /** How many were added. */
    expected<std::uint32_t> particles_fill(const pbmpm_fill_def &def, const pbmpm_shape &form) const noexcept
    {
        std::uint32_t added = 0;
        return detail::got_or_needed(pbmpm_particles_fill(id_, &def, &form, &added), added);
    }
    expected<void> particles_remove(span<const pbmpm_particle_id> ids) const noexcept
    {
        if (!detail::countable(ids)) return detail::refused("particles_remove: too many identifiers");
        return detail::done(pbmpm_particles_remove(id_, ids.data(), detail::room(ids)));
    }
    /** How many were removed. */
    expected<std::uint32_t> particles_remove_in(const pbmpm_shape &form) const noexcept
    {
        std::uint32_t removed = 0;
        return detail::got(pbmpm_particles_remove_in(id_, &form, &removed), removed);
    }
    expected<std::uint32_t> particles_count() const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_particles_count(id_, &count), count);
    }
    expected<view> particles_view(pbmpm_field field) const noexcept
    {
        view it{detail::sized<pbmpm_view>()};
        return detail::got(pbmpm_particles_view(id_, field, &it), it);
    }
    /** How many particles were copied. */
    expected<std::uint32_t> particles_copy(const pbmpm_copy_def &def, span<std::byte> buffer) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got_or_needed(pbmpm_particles_copy(id_, &def, detail::not_null(buffer), buffer.size(), &count), count);
    }
    /** Sets a field of some particles, tightly packed. */
    expected<void> particles_set(pbmpm_field field, span<const pbmpm_particle_id> ids, span<const float> values) const noexcept
    {
        return set_field<float>(field, ids, values);
    }
    /** Sets PBMPM_USER_VALUE of some particles. */
    expected<void> particles_set(span<const pbmpm_particle_id> ids, span<const std::uint32_t> user_values) const noexcept
    {
        return set_field<std::uint32_t>(PBMPM_USER_VALUE, ids, user_values);
    }
    /** Sets a field of all particles in the order of views, tightly packed. */
    expected<void> particles_set_all(pbmpm_field field, span<const float> values) const noexcept { return set_all<float>(field, values); }
    /** Sets PBMPM_USER_VALUE of all particles in the order of views. */
    expected<void> particles_set_all(span<const std::uint32_t> user_values) const noexcept { return set_all<std::uint32_t>(PBMPM_USER_VALUE, user_values); }
    /** `rows`: as many as `ids`, or more. */
    expected<void> particles_find(span<const pbmpm_particle_id> ids, span<std::uint32_t> rows) const noexcept
    {
        if (!detail::countable(ids) || rows.size() < ids.size()) return detail::refused("particles_find: there is room for fewer rows than identifiers");
        return detail::done(pbmpm_particles_find(id_, ids.data(), detail::room(ids), rows.data()));
    }

    /* Colliders (collider.h). */
    expected<pbmpm_collider_id> collider_create(const pbmpm_collider_def &def, const pbmpm_shape &form) const noexcept
    {
        pbmpm_collider_id collider{};
        return detail::got(pbmpm_collider_create(id_, &def, &form, &collider), collider);
    }
    expected<void> collider_destroy(pbmpm_collider_id collider) const noexcept { return detail::done(pbmpm_collider_destroy(id_, collider)); }
    expected<bool> collider_is_valid(pbmpm_collider_id collider) const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_collider_is_valid(id_, collider, &valid), valid);
    }
    expected<std::uint32_t> get_colliders(span<pbmpm_collider_id> colliders) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_get_colliders(id_, colliders.data(), detail::room(colliders), &count), count);
    }
    expected<placed<pbmpm_collider_def>> collider_get(pbmpm_collider_id collider) const noexcept
    {
        placed<pbmpm_collider_def> it{detail::sized<pbmpm_collider_def>(), detail::sized<pbmpm_shape>()};
        return detail::got(pbmpm_collider_get(id_, collider, &it.def, &it.shape), it);
    }
    /** A null part stays as it is. */
    expected<void> collider_set(pbmpm_collider_id collider, const pbmpm_collider_def *def, const pbmpm_shape *form = nullptr) const noexcept
    {
        return detail::done(pbmpm_collider_set(id_, collider, def, form));
    }
    expected<void> collider_move(pbmpm_collider_id collider, const vector3 &position) const noexcept
    {
        return detail::done(pbmpm_collider_move(id_, collider, position.data(), nullptr));
    }
    expected<void> collider_move(pbmpm_collider_id collider, const vector3 &position, const quaternion &rotation) const noexcept
    {
        return detail::done(pbmpm_collider_move(id_, collider, position.data(), rotation.data()));
    }
    expected<void> collider_teleport(pbmpm_collider_id collider, const vector3 &position) const noexcept
    {
        return detail::done(pbmpm_collider_teleport(id_, collider, position.data(), nullptr));
    }
    expected<void> collider_teleport(pbmpm_collider_id collider, const vector3 &position, const quaternion &rotation) const noexcept
    {
        return detail::done(pbmpm_collider_teleport(id_, collider, position.data(), rotation.data()));
    }
    expected<pbmpm_impulse> collider_impulse(pbmpm_collider_id collider) const noexcept
    {
        auto impulse = detail::sized<pbmpm_impulse>();
        return detail::got(pbmpm_collider_impulse(id_, collider, &impulse), impulse);
    }
    expected<pbmpm_impulse> domain_impulse(int axis, bool upper) const noexcept
    {
        auto impulse = detail::sized<pbmpm_impulse>();
        return detail::got(pbmpm_domain_impulse(id_, axis, upper, &impulse), impulse);
    }
    expected<pbmpm_domain_wall> domain_wall_get(int axis, bool upper) const noexcept
    {
        auto wall = detail::sized<pbmpm_domain_wall>();
        return detail::got(pbmpm_domain_wall_get(id_, axis, upper, &wall), wall);
    }
    expected<void> domain_wall_set(int axis, bool upper, const pbmpm_domain_wall &wall) const noexcept
    {
        return detail::done(pbmpm_domain_wall_set(id_, axis, upper, &wall));
    }
    expected<std::uint32_t> touches(span<pbmpm_touch> touches) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_touches(id_, detail::sized(touches), detail::room(touches), &count), count);
    }

    /* Rigid bodies (rigid.h). */
    expected<pbmpm_mass_properties> shape_mass(const pbmpm_shape &form, float density) const noexcept
    {
        auto mass = detail::sized<pbmpm_mass_properties>();
        return detail::got(pbmpm_shape_mass(id_, &form, density, &mass), mass);
    }
    /** With a null `material` all matter counts. */
    expected<pbmpm_submersion> collider_submerged(pbmpm_collider_id collider, const pbmpm_material_id *material = nullptr) const noexcept
    {
        auto submersion = detail::sized<pbmpm_submersion>();
        return detail::got(pbmpm_collider_submerged(id_, collider, material, &submersion), submersion);
    }
    expected<pbmpm_rigid_state> rigid_begin(pbmpm_collider_id collider, const pbmpm_rigid_def &def) const noexcept
    {
        auto state = detail::sized<pbmpm_rigid_state>();
        return detail::got(pbmpm_rigid_begin(id_, collider, &def, &state), state);
    }
    expected<void> rigid_advance(pbmpm_collider_id collider, const pbmpm_rigid_def &def, pbmpm_rigid_state &state, float dt) const noexcept
    {
        return detail::done(pbmpm_rigid_advance(id_, collider, &def, &state, dt));
    }

    /* Baked solids (solid.h). */
    expected<pbmpm_baked_id> baked_create(span<const std::byte> data) const noexcept
    {
        pbmpm_baked_id baked{};
        return detail::got(pbmpm_baked_create(id_, data.data(), data.size(), &baked), baked);
    }
    expected<pbmpm_baked_info> baked_get(pbmpm_baked_id baked) const noexcept
    {
        auto info = detail::sized<pbmpm_baked_info>();
        return detail::got(pbmpm_baked_get(id_, baked, &info), info);
    }
    expected<void> baked_destroy(pbmpm_baked_id baked) const noexcept { return detail::done(pbmpm_baked_destroy(id_, baked)); }

    /* Emitters (emitter.h). */
    expected<pbmpm_emitter_id> emitter_create(const pbmpm_emitter_def &def, const pbmpm_shape &form) const noexcept
    {
        pbmpm_emitter_id emitter{};
        return detail::got(pbmpm_emitter_create(id_, &def, &form, &emitter), emitter);
    }
    expected<void> emitter_destroy(pbmpm_emitter_id emitter) const noexcept { return detail::done(pbmpm_emitter_destroy(id_, emitter)); }
    expected<bool> emitter_is_valid(pbmpm_emitter_id emitter) const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_emitter_is_valid(id_, emitter, &valid), valid);
    }
    expected<std::uint32_t> get_emitters(span<pbmpm_emitter_id> emitters) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_get_emitters(id_, emitters.data(), detail::room(emitters), &count), count);
    }
    expected<placed<pbmpm_emitter_def>> emitter_get(pbmpm_emitter_id emitter) const noexcept
    {
        placed<pbmpm_emitter_def> it{detail::sized<pbmpm_emitter_def>(), detail::sized<pbmpm_shape>()};
        return detail::got(pbmpm_emitter_get(id_, emitter, &it.def, &it.shape), it);
    }
    /** A null part stays as it is. */
    expected<void> emitter_set(pbmpm_emitter_id emitter, const pbmpm_emitter_def *def, const pbmpm_shape *form = nullptr) const noexcept
    {
        return detail::done(pbmpm_emitter_set(id_, emitter, def, form));
    }
    expected<void> emitter_move(pbmpm_emitter_id emitter, const vector3 &position) const noexcept
    {
        return detail::done(pbmpm_emitter_move(id_, emitter, position.data(), nullptr));
    }
    expected<void> emitter_move(pbmpm_emitter_id emitter, const vector3 &position, const quaternion &rotation) const noexcept
    {
        return detail::done(pbmpm_emitter_move(id_, emitter, position.data(), rotation.data()));
    }
    expected<pbmpm_emitter_status> emitter_status_get(pbmpm_emitter_id emitter) const noexcept
    {
        auto status = detail::sized<pbmpm_emitter_status>();
        return detail::got(pbmpm_emitter_status_get(id_, emitter, &status), status);
    }

    /* Drains, kill bounds, and what came and went (drain.h). */
    expected<pbmpm_drain_id> drain_create(const pbmpm_drain_def &def, const pbmpm_shape &form) const noexcept
    {
        pbmpm_drain_id drain{};
        return detail::got(pbmpm_drain_create(id_, &def, &form, &drain), drain);
    }
    expected<void> drain_destroy(pbmpm_drain_id drain) const noexcept { return detail::done(pbmpm_drain_destroy(id_, drain)); }
    expected<bool> drain_is_valid(pbmpm_drain_id drain) const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_drain_is_valid(id_, drain, &valid), valid);
    }
    expected<std::uint32_t> get_drains(span<pbmpm_drain_id> drains) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_get_drains(id_, drains.data(), detail::room(drains), &count), count);
    }
    expected<placed<pbmpm_drain_def>> drain_get(pbmpm_drain_id drain) const noexcept
    {
        placed<pbmpm_drain_def> it{detail::sized<pbmpm_drain_def>(), detail::sized<pbmpm_shape>()};
        return detail::got(pbmpm_drain_get(id_, drain, &it.def, &it.shape), it);
    }
    /** A null part stays as it is. */
    expected<void> drain_set(pbmpm_drain_id drain, const pbmpm_drain_def *def, const pbmpm_shape *form = nullptr) const noexcept
    {
        return detail::done(pbmpm_drain_set(id_, drain, def, form));
    }
    expected<pbmpm_drain_status> drain_status_get(pbmpm_drain_id drain) const noexcept
    {
        auto status = detail::sized<pbmpm_drain_status>();
        return detail::got(pbmpm_drain_status_get(id_, drain, &status), status);
    }
    expected<pbmpm_kill_bounds> get_kill_bounds() const noexcept
    {
        auto bounds = detail::sized<pbmpm_kill_bounds>();
        return detail::got(pbmpm_world_get_kill_bounds(id_, &bounds), bounds);
    }
    expected<void> set_kill_bounds(const pbmpm_kill_bounds &bounds) const noexcept { return detail::done(pbmpm_world_set_kill_bounds(id_, &bounds)); }
    expected<pbmpm_flow> get_flow() const noexcept
    {
        auto flow = detail::sized<pbmpm_flow>();
        return detail::got(pbmpm_world_get_flow(id_, &flow), flow);
    }

    /* Forces (force.h). */
    expected<pbmpm_force_id> force_create(const pbmpm_force_def &def, const pbmpm_shape &form) const noexcept
    {
        pbmpm_force_id force{};
        return detail::got(pbmpm_force_create(id_, &def, &form, &force), force);
    }
    expected<void> force_destroy(pbmpm_force_id force) const noexcept { return detail::done(pbmpm_force_destroy(id_, force)); }
    expected<bool> force_is_valid(pbmpm_force_id force) const noexcept
    {
        std::int32_t valid = 0;
        return detail::answer(pbmpm_force_is_valid(id_, force, &valid), valid);
    }
    expected<std::uint32_t> get_forces(span<pbmpm_force_id> forces) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_world_get_forces(id_, forces.data(), detail::room(forces), &count), count);
    }
    expected<placed<pbmpm_force_def>> force_get(pbmpm_force_id force) const noexcept
    {
        placed<pbmpm_force_def> it{detail::sized<pbmpm_force_def>(), detail::sized<pbmpm_shape>()};
        return detail::got(pbmpm_force_get(id_, force, &it.def, &it.shape), it);
    }
    /** A null part stays as it is. */
    expected<void> force_set(pbmpm_force_id force, const pbmpm_force_def *def, const pbmpm_shape *form = nullptr) const noexcept
    {
        return detail::done(pbmpm_force_set(id_, force, def, form));
    }
    expected<pbmpm_force_status> force_status_get(pbmpm_force_id force) const noexcept
    {
        auto status = detail::sized<pbmpm_force_status>();
        return detail::got(pbmpm_force_status_get(id_, force, &status), status);
    }

    /* Questions (query.h). Of a list as much is written as there is room for; the value is how many there are. */
    expected<std::uint32_t> query_shape(const pbmpm_shape &form, span<pbmpm_particle_id> ids) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_query_shape(id_, &form, ids.data(), detail::room(ids), &count), count);
    }
    expected<std::uint32_t> query_collider(pbmpm_collider_id collider, span<pbmpm_particle_id> ids) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_query_collider(id_, collider, ids.data(), detail::room(ids), &count), count);
    }
    expected<std::uint32_t> query_region(const pbmpm_shape &form, span<pbmpm_region_share> shares) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got(pbmpm_query_region(id_, &form, detail::sized(shares), detail::room(shares), &count), count);
    }
    /** `points` are of the world's dimension d. An answer is empty, or has room for all points: `velocity` for d components each. */
    expected<void> query_points(span<const float> points, span<float> filling, span<float> density = {}, span<float> velocity = {}) const noexcept
    {
        const auto count = point_count(points);
        if (!count) return count.error();
        const bool fits = (filling.empty() || filling.size() >= *count) && (density.empty() || density.size() >= *count) &&
                          (velocity.empty() || velocity.size() >= points.size());
        if (*count == 0) return {};
        if (!fits) return detail::refused("query_points: there is room for fewer answers than points");
        return detail::done(pbmpm_query_points(id_, points.data(), *count, detail::or_null(filling), detail::or_null(density), detail::or_null(velocity)));
    }
    /** `points` are of the world's dimension d, `heights` as many; `direction` has d components, or none: against gravity. */
    expected<void> query_heights(span<const float> points, span<float> heights, float level = 0.5f, span<const float> direction = {}) const noexcept
    {
        const auto count = point_count(points);
        if (!count) return count.error();
        if (*count == 0) return {};
        if (heights.size() < *count) return detail::refused("query_heights: there is room for fewer heights than points");
        if (!direction.empty() && direction.size() * *count < points.size()) return detail::refused("query_heights: the direction lacks components");
        return detail::done(pbmpm_query_heights(id_, points.data(), *count, detail::or_null(direction), level, heights.data()));
    }
    expected<pbmpm_ray_hit> query_ray(const pbmpm_ray &way) const noexcept
    {
        auto hit = detail::sized<pbmpm_ray_hit>();
        return detail::got(pbmpm_query_ray(id_, &way, &hit), hit);
    }

    /* Surfaces (surface.h). */
    /** Writes to where the pointers of `mesh` lead, and its counts, which a failure with CAPACITY writes too. With null pointers it only counts. */
    expected<void> surface_extract(const pbmpm_surface_def &def, pbmpm_surface_mesh &mesh) const noexcept
    {
        mesh.size = sizeof mesh;
        return detail::done(pbmpm_surface_extract(id_, &def, &mesh));
    }
    /** How many points were written. */
    expected<std::uint32_t> surface_points(const pbmpm_points_def &def, span<pbmpm_point> points) const noexcept
    {
        std::uint32_t count = 0;
        return detail::got_or_needed(pbmpm_surface_points(id_, &def, points.data(), detail::room(points), &count), count);
    }

    /* Sleeping (sleep.h) and saves (snapshot.h). */
    /** With a null shape all of the world. */
    expected<void> wake(const pbmpm_shape *form = nullptr) const noexcept { return detail::done(pbmpm_world_wake(id_, form)); }
    expected<snapshot_bytes> snapshot_size() const noexcept
    {
        snapshot_bytes bytes{};
        return detail::got(pbmpm_snapshot_size(id_, &bytes.all, &bytes.per_particle), bytes);
    }
    /** How many bytes were written. */
    expected<std::uint64_t> snapshot_save(span<std::byte> buffer) const noexcept
    {
        std::uint64_t bytes = 0;
        return detail::got_or_needed(pbmpm_snapshot_save(id_, detail::not_null(buffer), buffer.size(), &bytes), bytes);
    }
    expected<void> snapshot_restore(span<const std::byte> snapshot, std::uint32_t flags = 0) const noexcept
    {
        return detail::done(pbmpm_snapshot_restore(id_, snapshot.data(), snapshot.size(), flags));
    }

protected:
    pbmpm_world_id id_{};

private:
    expected<std::size_t> dimension() const noexcept
    {
        const auto def = get_def();
        if (!def) return def.error();
        return static_cast<std::size_t>(def->dimension);
    }
    expected<std::uint32_t> point_count(span<const float> points) const noexcept
    {
        const auto d = dimension();
        if (!d) return d.error();
        if (points.size() % *d != 0) return detail::refused("the points do not have the world's dimension");
        if (points.size() / *d > UINT32_MAX) return detail::refused("too many points");
        return static_cast<std::uint32_t>(points.size() / *d);
    }
    /* How many values a field has that can be set. */
    expected<std::size_t> components(pbmpm_field field) const noexcept
    {
        const auto d = dimension();
        if (!d) return d.error();
        switch (field) {
        case PBMPM_POSITION:
        case PBMPM_VELOCITY: return *d;
        case PBMPM_AFFINE_VELOCITY:
        case PBMPM_DEFORMATION: return *d * *d;
        default: return std::size_t{1};
        }
    }
    template <class T> expected<void> set_field(pbmpm_field field, span<const pbmpm_particle_id> ids, span<const T> values) const noexcept
    {
        if (std::is_same_v<T, float> == (field == PBMPM_USER_VALUE)) return detail::refused("particles_set: user values are integers");
        const auto each = components(field);
        if (!each) return each.error();
        if (!detail::countable(ids) || values.size() != ids.size() * *each) return detail::refused("particles_set: the values do not match the identifiers");
        if (ids.empty()) return {}; /* null identifiers would stand for all particles */
        return detail::done(pbmpm_particles_set(id_, field, ids.data(), detail::room(ids), values.data()));
    }
    template <class T> expected<void> set_all(pbmpm_field field, span<const T> values) const noexcept
    {
        if (std::is_same_v<T, float> == (field == PBMPM_USER_VALUE)) return detail::refused("particles_set_all: user values are integers");
        const auto each = components(field);
        if (!each) return each.error();
        if (values.size() % *each != 0 || values.size() / *each > UINT32_MAX) return detail::refused("particles_set_all: the values do not match the particles");
        return detail::done(pbmpm_particles_set(id_, field, nullptr, static_cast<std::uint32_t>(values.size() / *each), values.data()));
    }
};

/** A world that is destroyed at the end of its life. It can be moved, not copied. */
class world : public world_ref {
public:
    /** Names no world. */
    world() noexcept = default;
    /** Takes over a world that C made. */
    explicit world(pbmpm_world_id id) noexcept : world_ref(id) {}
    world(world &&other) noexcept : world_ref(other.release()) {}
    world &operator=(world &&other) noexcept
    {
        world before(std::exchange(id_, other.release()));
        return *this;
    }
    world(const world &) = delete;
    world &operator=(const world &) = delete;
    /** Another thread that is in the world keeps it alive; destroy() tells of that. */
    ~world()
    {
        if (!is_null(id_)) static_cast<void>(pbmpm_world_destroy(id_));
    }

    static expected<world> create(const pbmpm_world_def &def) noexcept
    {
        pbmpm_world_id id{};
        const pbmpm_result result = pbmpm_world_create(&def, &id);
        if (result != PBMPM_OK) return detail::why(result);
        return world(id);
    }
    /** Destroys the world now. On failure it is still there. */
    expected<void> destroy() noexcept
    {
        const pbmpm_result result = pbmpm_world_destroy(id_);
        if (result == PBMPM_OK) id_ = {};
        return detail::done(result);
    }
    /** Gives the world away without destroying it. */
    pbmpm_world_id release() noexcept { return std::exchange(id_, pbmpm_world_id{}); }
};

/* What needs no world. */

inline const char *result_name(pbmpm_result result) noexcept { return pbmpm_result_name(result); }
inline const char *last_error() noexcept { return pbmpm_last_error(); }
inline const char *isa_name(pbmpm_isa isa) noexcept { return pbmpm_isa_name(isa); }
inline const char *advice_name(pbmpm_advice_code code) noexcept { return pbmpm_advice_name(code); }
inline const char *advice_unit(pbmpm_advice_code code) noexcept { return pbmpm_advice_unit(code); }
inline std::uint32_t version() noexcept { return pbmpm_version(); }
inline std::uint32_t abi_version() noexcept { return pbmpm_abi_version(); }
inline pbmpm_isa active_isa() noexcept { return pbmpm_active_isa(); }
inline bool build_is_strict() noexcept { return pbmpm_build_is_strict() != 0; }
inline std::uint32_t materials_built() noexcept { return pbmpm_materials_built(); }
inline expected<void> shutdown() noexcept { return detail::done(pbmpm_shutdown()); }
inline expected<void> set_log_callback(pbmpm_log_callback *callback, void *user = nullptr) noexcept
{
    return detail::done(pbmpm_set_log_callback(callback, user));
}
inline expected<void> set_assert_callback(pbmpm_assert_callback *callback, void *user = nullptr) noexcept
{
    return detail::done(pbmpm_set_assert_callback(callback, user));
}
inline expected<span<const pbmpm_layout_entry>> layout_table() noexcept
{
    const pbmpm_layout_entry *entries = nullptr;
    std::uint32_t count = 0;
    const pbmpm_result result = pbmpm_layout_table(&entries, &count);
    if (result != PBMPM_OK) return detail::why(result);
    return span<const pbmpm_layout_entry>(entries, count);
}
inline expected<std::uint32_t> get_worlds(span<pbmpm_world_id> worlds) noexcept
{
    std::uint32_t count = 0;
    return detail::got(pbmpm_get_worlds(worlds.data(), detail::room(worlds), &count), count);
}

/* Baking (solid.h): the bytes that a solid takes; with an empty buffer the size alone. */

inline expected<std::uint64_t> bake_mesh(const pbmpm_mesh_def &def, span<std::byte> buffer) noexcept
{
    std::uint64_t bytes = 0;
    return detail::got_or_needed(pbmpm_bake_mesh(&def, detail::or_null(buffer), buffer.size(), &bytes), bytes);
}
inline expected<std::uint64_t> bake_hull(const pbmpm_mesh_def &def, span<std::byte> buffer) noexcept
{
    std::uint64_t bytes = 0;
    return detail::got_or_needed(pbmpm_bake_hull(&def, detail::or_null(buffer), buffer.size(), &bytes), bytes);
}
inline expected<std::uint64_t> bake_heights(const pbmpm_heights_def &def, span<std::byte> buffer) noexcept
{
    std::uint64_t bytes = 0;
    return detail::got_or_needed(pbmpm_bake_heights(&def, detail::or_null(buffer), buffer.size(), &bytes), bytes);
}
inline expected<pbmpm_baked_info> baked_inspect(span<const std::byte> data) noexcept
{
    auto info = detail::sized<pbmpm_baked_info>();
    return detail::got(pbmpm_baked_inspect(data.data(), data.size(), &info), info);
}

} // namespace pbmpm

/* Where C's identifiers are, so that they are found. */
template <class Id, class = std::enable_if_t<pbmpm::detail::is_id<Id>::value>> constexpr bool operator==(Id a, Id b) noexcept
{
    return a.index == b.index && a.generation == b.generation;
}
template <class Id, class = std::enable_if_t<pbmpm::detail::is_id<Id>::value>> constexpr bool operator!=(Id a, Id b) noexcept { return !(a == b); }

#endif
