/* pbmpm_engine: a world in the frame loop of a host. It has no callbacks: the host sets what it knows before a frame, and reads what came of it afterwards. */
#ifndef PBMPM_ENGINE_SIMULATION_HPP
#define PBMPM_ENGINE_SIMULATION_HPP

#include "body.hpp"
#include "clock.hpp"

#include <vector>

namespace pbmpm::engine {

/** What a simulation is made of. */
struct options {
    world_def world;
    pbmpm::settings settings;
    double dt = 1.0 / 60;    /**< of a step [s], in (0, 10] */
    int most_steps = 2;      /**< per frame, 1 to 60 */
    bool background = false; /**< true: the last step of a frame runs while the host does something else. Then what is drawn is a step older. */
};

/** A world and its clock; bodies that are coupled to it; colliders and emitters that follow something of the host's.
 *  One thread at a time uses it. Errors are those of the library's calls that it makes. */
class simulation {
public:
    /** Errors: INVALID_ARGUMENT (dt, most_steps), and those of pbmpm_world_create() and pbmpm_world_set_settings(). */
    static expected<simulation> create(const options &wanted) noexcept
    {
        if (!(wanted.dt > 0 && wanted.dt <= 10)) return pbmpm::detail::refused("simulation: a step lasts more than 0 s, and 10 s at most");
        if (wanted.most_steps < 1 || wanted.most_steps > 60) return pbmpm::detail::refused("simulation: a frame has 1 to 60 steps at most");
        auto world = world::create(wanted.world);
        if (!world) return world.error();
        if (auto set = world->set_settings(wanted.settings); !set) return set.error();
        return simulation(std::move(*world), wanted);
    }

    /** The world, for calls that may be made while a step runs (async.h). */
    const world_ref &reading() const noexcept { return world_; }
    /** The world, for all calls. Waits for a step in the background. */
    expected<world_ref> editing() noexcept
    {
        if (auto ended = settle(); !ended) return ended.error();
        return world_ref(world_.id());
    }
    const engine::clock &clock() const noexcept { return clock_; }

    /** Couples a body; the value is its number. Errors: INVALID_ARGUMENT (mass). */
    expected<std::size_t> add_body(const body &wanted)
    {
        if (!(wanted.mass() > 0)) return pbmpm::detail::refused("simulation: a body's mass is greater than 0");
        if (auto ended = settle(); !ended) return ended.error();
        bodies_.push_back(wanted);
        return bodies_.size() - 1;
    }
    /** How many were added. */
    std::size_t body_count() const noexcept { return bodies_.size(); }
    /** Number `number` of those that were added. */
    body &body_at(std::size_t number) noexcept { return assert(number < bodies_.size()), bodies_[number]; }
    /** Ends the coupling, and destroys the collider. Other bodies keep their numbers. */
    expected<void> remove_body(std::size_t number) noexcept
    {
        const auto world = editing();
        if (!world) return world.error();
        if (number >= bodies_.size() || is_null(bodies_[number].collider())) return pbmpm::detail::refused("simulation: there is no such body");
        if (auto gone = world->collider_destroy(bodies_[number].collider()); !gone) return gone;
        bodies_[number] = body({}, 1);
        return {};
    }

    /** Sends a kinematic collider or an emitter on its way. It arrives with the last step of the next frame that has steps. Each step takes an equal
     *  part of the way. */
    template <class Id> void follow(Id what, const vector3 &position, const quaternion &rotation)
    {
        static_assert(std::is_same_v<Id, pbmpm_collider_id> || std::is_same_v<Id, pbmpm_emitter_id>);
        for (follower &it : followers_) {
            if (!it.is(what)) continue;
            it.wanted = {position, rotation};
            it.moves = true;
            return;
        }
        follower it;
        it.set(what);
        it.was = it.wanted = {position, rotation};
        it.moves = true;
        followers_.push_back(it);
    }
    /** Forgets a collider or an emitter, before the host destroys it. */
    template <class Id> void leave(Id what) noexcept
    {
        for (std::size_t i = 0; i < followers_.size(); i++)
            if (followers_[i].is(what)) {
                followers_[i] = followers_.back();
                followers_.pop_back();
                return;
            }
    }

    /** Makes the steps that a frame of `seconds` owes; the value is their number. With a failure the frame ends early, and the next one goes on. */
    expected<int> frame(double seconds) noexcept
    {
        if (auto ended = settle(); !ended) return ended.error();
        const int steps = clock_.advance(seconds);
        for (int step = 1; step <= steps; step++) {
            if (auto begun = begin_step(static_cast<float>(step) / static_cast<float>(steps)); !begun) return begun.error();
            if (background_ && step == steps) {
                if (auto running = world_.step_begin(dt()); !running) return running.error();
                runs_ = true;
                break;
            }
            if (auto stepped = world_.step(dt()); !stepped) return stepped.error();
            if (auto ended = end_step(); !ended) return ended.error();
        }
        if (steps > 0) arrive();
        return steps;
    }
    /** Waits for the step that runs in the background, if one does. */
    expected<void> settle() noexcept
    {
        if (!runs_) return {};
        runs_ = false;
        if (auto ended = world_.step_end(); !ended) return ended;
        return end_step();
    }

private:
    struct pose {
        vector3 position{};
        quaternion rotation{0, 0, 0, 1};
    };
    struct follower {
        pbmpm_collider_id collider{};
        pbmpm_emitter_id emitter{};
        pose was, wanted;
        bool moves = false;

        bool is(pbmpm_collider_id id) const noexcept { return !is_null(id) && collider == id; }
        bool is(pbmpm_emitter_id id) const noexcept { return !is_null(id) && emitter == id; }
        void set(pbmpm_collider_id id) noexcept { collider = id; }
        void set(pbmpm_emitter_id id) noexcept { emitter = id; }
    };

    simulation(pbmpm::world &&made, const options &wanted) noexcept
        : world_(std::move(made)), clock_(wanted.dt, wanted.most_steps), background_(wanted.background),
          gravity_{wanted.settings.gravity[0], wanted.settings.gravity[1], wanted.settings.gravity[2]}
    {
    }
    float dt() const noexcept { return static_cast<float>(clock_.dt()); }
    /* Between two poses; quaternions q and -q are the same turn, so the shorter way is taken. */
    static pose between(const pose &a, const pose &b, float share) noexcept
    {
        pose it;
        float along = 0;
        for (std::size_t i = 0; i < 4; i++) along += a.rotation[i] * b.rotation[i];
        for (std::size_t i = 0; i < 4; i++) it.rotation[i] = (1 - share) * (along < 0 ? -a.rotation[i] : a.rotation[i]) + share * b.rotation[i];
        it.rotation = detail::normalised(it.rotation);
        for (std::size_t i = 0; i < 3; i++) it.position[i] = (1 - share) * a.position[i] + share * b.position[i];
        return it;
    }
    expected<void> begin_step(float share) noexcept
    {
        for (const follower &it : followers_) {
            if (!it.moves) continue;
            const pose now = between(it.was, it.wanted, share);
            auto moved = is_null(it.collider) ? world_.emitter_move(it.emitter, now.position, now.rotation)
                                              : world_.collider_move(it.collider, now.position, now.rotation);
            if (!moved) return moved;
        }
        for (body &it : bodies_)
            if (!is_null(it.collider()))
                if (auto sent = it.before_step(world_, dt()); !sent) return sent;
        return {};
    }
    expected<void> end_step() noexcept
    {
        for (body &it : bodies_)
            if (!is_null(it.collider()))
                if (auto pushed = it.after_step(world_, dt(), gravity_); !pushed) return pushed;
        return {};
    }
    void arrive() noexcept
    {
        for (follower &it : followers_) {
            it.was = it.wanted;
            it.moves = false;
        }
    }

    pbmpm::world world_;
    engine::clock clock_;
    bool background_, runs_ = false;
    vector3 gravity_;
    std::vector<body> bodies_;
    std::vector<follower> followers_;
};

} // namespace pbmpm::engine
#endif
