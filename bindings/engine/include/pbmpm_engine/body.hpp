/* pbmpm_engine: rigid bodies of a host's physics engine, which matter pushes and which push matter. */
#ifndef PBMPM_ENGINE_BODY_HPP
#define PBMPM_ENGINE_BODY_HPP

#include "coordinates.hpp"

namespace pbmpm::engine {

/** How a body is and moves, in the world's coordinates. */
struct motion {
    vector3 position{};           /**< of the collider's shape [m] */
    quaternion rotation{0, 0, 0, 1};
    vector3 velocity{};           /**< of the centre of mass [m/s] */
    vector3 angular_velocity{};   /**< [rad/s] */
};

/** What matter gave to a body. */
struct push {
    vector3 linear{};  /**< [N s] */
    vector3 angular{}; /**< about the centre of mass [N m s] */
};

namespace detail {

constexpr vector3 cross(const vector3 &a, const vector3 &b) noexcept
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
constexpr vector3 sum(const vector3 &a, const vector3 &b, float share = 1) noexcept
{
    return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}
inline quaternion normalised(const quaternion &q) noexcept
{
    const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return length > 0 ? quaternion{q[0] / length, q[1] / length, q[2] / length, q[3] / length} : quaternion{0, 0, 0, 1};
}
/* The turn by `angular_velocity` for `dt`, after `rotation`. */
inline quaternion turned_on(const quaternion &rotation, const vector3 &angular_velocity, float dt) noexcept
{
    const float speed = std::sqrt(angular_velocity[0] * angular_velocity[0] + angular_velocity[1] * angular_velocity[1] + angular_velocity[2] * angular_velocity[2]);
    const float half = 0.5f * speed * dt, share = speed > 0 ? std::sin(half) / speed : 0;
    const quaternion turn{share * angular_velocity[0], share * angular_velocity[1], share * angular_velocity[2], std::cos(half)};
    return normalised(coordinates::product(turn, rotation));
}

} // namespace detail

/** A vector after a turn: v + 2 w (u x v) + 2 u x (u x v), with the quaternion (u, w). */
constexpr vector3 turned(const quaternion &turn, const vector3 &v) noexcept
{
    const vector3 u{turn[0], turn[1], turn[2]}, across = detail::cross(u, v);
    return detail::sum(detail::sum(v, across, 2 * turn[3]), detail::cross(u, across), 2);
}

/** A body that a physics engine moves, and its collider, which is kinematic and measures its impulse.
 *
 *  Each frame the host says how the body moves, by set_motion(). Before a step the collider is sent where the body's velocity takes it. After it the body has a push,
 *  which the host gives to its physics engine. If a frame has several steps, the body goes on between them: by its velocity, its weight and its pushes. Its
 *  angular velocity stays as the host said.
 *
 *  The push is smoothed by the virtual mass of rigid.h: a body that is lighter than the matter that moves along would otherwise oscillate. */
class body {
public:
    /** `mass`: [kg], above 0; `centre`: of mass, from the collider's position along the body's own axes in the world's coordinates [m]. */
    body(pbmpm_collider_id collider, float mass, const vector3 &centre = {}) noexcept : collider_(collider), mass_(mass), centre_(centre) {}

    pbmpm_collider_id collider() const noexcept { return collider_; }
    float mass() const noexcept { return mass_; }
    void set_motion(const motion &now) noexcept { motion_ = now; }
    /** As set, and gone on with the steps since. */
    const motion &get_motion() const noexcept { return motion_; }
    /** Sends the collider where the body will be after `dt`. Errors: those of pbmpm_collider_move(). */
    expected<void> before_step(const world_ref &world, float dt) noexcept
    {
        const vector3 centre = detail::sum(detail::sum(motion_.position, turned(motion_.rotation, centre_)), motion_.velocity, dt);
        motion_.rotation = detail::turned_on(motion_.rotation, motion_.angular_velocity, dt);
        motion_.position = detail::sum(centre, turned(motion_.rotation, centre_), -1);
        return world.collider_move(collider_, motion_.position, motion_.rotation);
    }
    /** Adds what matter gave in the step to the push, and lets gravity act. Errors: those of pbmpm_collider_impulse() and pbmpm_collider_submerged(). */
    expected<void> after_step(const world_ref &world, float dt, const vector3 &gravity) noexcept
    {
        const auto impulse = world.collider_impulse(collider_);
        if (!impulse) return impulse.error();
        const auto under = world.collider_submerged(collider_);
        if (!under) return under.error();
        const float virtual_share = static_cast<float>(under->density * under->volume * under->share) / mass_;
        vector3 asked{}, turning{};
        for (std::size_t i = 0; i < 3; i++) {
            asked[i] = static_cast<float>(impulse->linear[i]);
            turning[i] = static_cast<float>(impulse->angular[i]);
        }
        for (std::size_t i = 0; i < 3; i++) last_[i] = (asked[i] + virtual_share * last_[i]) / (1 + virtual_share);
        /* From the collider's position to the centre of mass. */
        const vector3 away = turned(motion_.rotation, centre_);
        push_.angular = detail::sum(detail::sum(push_.angular, turning), detail::cross(away, asked), -1);
        push_.linear = detail::sum(push_.linear, last_);
        motion_.velocity = detail::sum(detail::sum(motion_.velocity, last_, 1 / mass_), gravity, dt);
        return {};
    }
    /** What came since it was last taken. */
    push take_push() noexcept { return std::exchange(push_, push{}); }

private:
    pbmpm_collider_id collider_;
    float mass_;
    vector3 centre_;
    motion motion_;
    vector3 last_{}; /* the last step's smoothed push [N s] */
    push push_;
};

} // namespace pbmpm::engine
#endif
