/* pbmpm_engine: a host's coordinates, and those of a world. */
#ifndef PBMPM_ENGINE_COORDINATES_HPP
#define PBMPM_ENGINE_COORDINATES_HPP

#include <pbmpm/pbmpm.hpp>

#include <cmath>

namespace pbmpm::engine {

/** How a host's axes and unit of length lie to those of a world, which are metres on right-handed axes.
 *
 *  Let M be the map of axes, a permutation with signs. A vector v of the host is M v of the world. A turn R is M R M^-1. So the axes of a body are
 *  mapped like those of the world. Where M is a mirror (its determinant is -1) an angular velocity w is -M w. So is the vector part of a quaternion. */
class coordinates {
public:
    /** Component i of a world's vector is `sign[i]` (1 or -1) times component `axis[i]` of the host's. `metres`: a unit of the host's length [m], above 0. */
    constexpr coordinates(std::array<int, 3> axis, std::array<float, 3> sign, float metres) noexcept : axis_(axis), sign_(sign), metres_(metres) {}

    /* From the host to the world. Quaternions are (x, y, z, w). */

    constexpr float length(float host) const noexcept { return host * metres_; }
    constexpr float volume(float host) const noexcept { return host * metres_ * metres_ * metres_; }
    /** A vector without unit: a normal, an axis that something moves along. */
    constexpr vector3 direction(const vector3 &host) const noexcept { return mapped(host, 1); }
    /** A position, a velocity, an acceleration. */
    constexpr vector3 vector(const vector3 &host) const noexcept { return mapped(host, metres_); }
    /** Lengths along a body's own axes, which have no sign. */
    constexpr vector3 extents(const vector3 &host) const noexcept { return permuted(host, metres_); }
    /** An angular velocity, or an axis that something turns about. */
    constexpr vector3 turning(const vector3 &host) const noexcept { return mapped(host, mirror()); }
    constexpr quaternion rotation(const quaternion &host) const noexcept
    {
        const vector3 turned = turning({host[0], host[1], host[2]});
        return {turned[0], turned[1], turned[2], host[3]};
    }
    /** Which axis of the world lies along an axis of the host. */
    constexpr int axis(int host) const noexcept { return axis_[0] == host ? 0 : axis_[1] == host ? 1 : 2; }

    /* From the world to the host. */

    constexpr float host_length(float world) const noexcept { return world / metres_; }
    constexpr vector3 host_direction(const vector3 &world) const noexcept { return unmapped(world, 1); }
    constexpr vector3 host_vector(const vector3 &world) const noexcept { return unmapped(world, 1 / metres_); }
    constexpr vector3 host_turning(const vector3 &world) const noexcept { return unmapped(world, mirror()); }
    constexpr quaternion host_rotation(const quaternion &world) const noexcept
    {
        const vector3 turned = host_turning({world[0], world[1], world[2]});
        return {turned[0], turned[1], turned[2], world[3]};
    }
    /** [N s] to kilograms times the host's unit per second. */
    constexpr vector3 host_impulse(const vector3 &world) const noexcept { return unmapped(world, 1 / metres_); }
    /** [N m s] to kilograms times the host's unit squared per second. */
    constexpr vector3 host_angular_impulse(const vector3 &world) const noexcept { return unmapped(world, mirror() / (metres_ * metres_)); }

    /* Shapes of the host. Positions and rotations are those of the host, as are lengths. */

    shape box(const vector3 &position, const quaternion &turn, const vector3 &half_extents) const noexcept
    {
        shape it = placed_at(PBMPM_BOX, position, rotation(turn));
        copy(it.half_extents, extents(half_extents));
        return it;
    }
    shape ball(const vector3 &position, float radius) const noexcept
    {
        shape it = placed_at(PBMPM_SPHERE, position, {0, 0, 0, 1});
        it.radius = length(radius);
        return it;
    }
    /** `along`: the host's axis that it lies along; `half_length`: of the segment between the centres of its round ends. */
    shape capsule(const vector3 &position, const quaternion &turn, float radius, float half_length, int along) const noexcept
    {
        shape it = placed_at(PBMPM_CAPSULE, position, capsule_rotation(turn, along));
        it.radius = length(radius);
        it.half_extents[0] = length(half_length);
        return it;
    }
    /** The rotation of such a capsule, for calls that move it. The library's capsules lie along the first axis: this turns it to another one. */
    quaternion capsule_rotation(const quaternion &turn, int along) const noexcept
    {
        constexpr float half = 0.70710678f; /* sine and cosine of an eighth of a turn */
        constexpr quaternion lay[3] = {{0, 0, 0, 1}, {0, 0, half, half}, {0, -half, 0, half}};
        return product(rotation(turn), lay[axis(along)]);
    }
    shape plane(const vector3 &position, const vector3 &normal) const noexcept
    {
        shape it = placed_at(PBMPM_PLANE, position, {0, 0, 0, 1});
        copy(it.normal, direction(normal));
        return it;
    }
    /** A solid that was baked from vertices in the world's coordinates. */
    shape baked(pbmpm_baked_id solid, const vector3 &position, const quaternion &turn) const noexcept
    {
        shape it = placed_at(PBMPM_BAKED, position, rotation(turn));
        it.baked = solid;
        return it;
    }

    /** The turn that `second` and then `first` make together. */
    static constexpr quaternion product(const quaternion &first, const quaternion &second) noexcept
    {
        const auto &a = first, &b = second;
        return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
    }

private:
    /* The vector along the world's axes, without signs. */
    constexpr vector3 permuted(const vector3 &host, float scale) const noexcept
    {
        vector3 world{};
        for (std::size_t i = 0; i < 3; i++) world[i] = host[static_cast<std::size_t>(axis_[i])] * scale;
        return world;
    }
    constexpr vector3 mapped(const vector3 &host, float scale) const noexcept
    {
        const vector3 world = permuted(host, scale);
        return {sign_[0] * world[0], sign_[1] * world[1], sign_[2] * world[2]};
    }
    constexpr vector3 unmapped(const vector3 &v, float scale) const noexcept
    {
        vector3 host{};
        for (std::size_t i = 0; i < 3; i++) host[static_cast<std::size_t>(axis_[i])] = sign_[i] * v[i] * scale;
        return host;
    }
    /* The determinant of the map of axes, 1 or -1. */
    constexpr float mirror() const noexcept
    {
        const bool even = (axis_[1] - axis_[0] + 3) % 3 == 1;
        return sign_[0] * sign_[1] * sign_[2] * (even ? 1.0f : -1.0f);
    }
    static void copy(float *to, const vector3 &from) noexcept
    {
        for (std::size_t i = 0; i < 3; i++) to[i] = from[i];
    }
    shape placed_at(pbmpm_shape_kind kind, const vector3 &position, const quaternion &turn) const noexcept
    {
        shape it;
        it.kind = kind;
        copy(it.position, vector(position));
        for (std::size_t i = 0; i < 4; i++) it.rotation[i] = turn[i];
        return it;
    }

    std::array<int, 3> axis_;
    std::array<float, 3> sign_;
    float metres_;
};

/** Unreal: centimetres, x forward, y right, z up, left-handed. The world has y up. */
inline constexpr coordinates unreal{{0, 2, 1}, {1, 1, 1}, 0.01f};
/** Unity: metres, x right, y up, z forward, left-handed. */
inline constexpr coordinates unity{{0, 1, 2}, {1, 1, -1}, 1};
/** Godot: as a world's. */
inline constexpr coordinates godot{{0, 1, 2}, {1, 1, 1}, 1};

} // namespace pbmpm::engine
#endif
