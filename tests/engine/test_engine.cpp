/* The layer that bindings to engines share: coordinates, clock, steps, coupled bodies, points. */
#include <pbmpm_engine/points.hpp>
#include <pbmpm_engine/simulation.hpp>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace engine = pbmpm::engine;
using pbmpm::quaternion;
using pbmpm::vector3;

static int checks, failures;
static long allocations;

/* Not inlined: gcc would warn that free() gets what operator new returned. */
[[gnu::noinline]] void *operator new(std::size_t size)
{
    allocations++;
    return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void *memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }

static void check(bool holds, const char *what, int line)
{
    checks++;
    if (holds) return;
    failures++;
    std::printf("test_engine.cpp:%d: does not hold: %s (%s)\n", line, what, pbmpm::last_error());
}
#define CHECK(condition) check(static_cast<bool>(condition), #condition, __LINE__)

/* Of numbers of the size of 1; 1e-5 is some 80 units in the last place. */
static bool near(const vector3 &a, const vector3 &b)
{
    for (std::size_t i = 0; i < 3; i++)
        if (!(std::abs(a[i] - b[i]) < 1e-5f * (1 + std::abs(a[i])))) return false;
    return true;
}

static const vector3 samples[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3f, -0.7f, 0.2f}};
static const quaternion turns[] = {{0, 0, 0, 1}, {0.5f, 0.5f, 0.5f, 0.5f}, {0, 0.6f, 0, 0.8f}, {0.1f, -0.5f, 0.7f, 0.5f}};

static void coordinates_keep_their_laws(const engine::coordinates &host)
{
    for (const vector3 &v : samples) {
        CHECK(near(host.host_vector(host.vector(v)), v));
        CHECK(near(host.host_direction(host.direction(v)), v));
        CHECK(near(host.host_turning(host.turning(v)), v));
        for (const quaternion &turn : turns) {
            const quaternion q = engine::detail::normalised(turn);
            /* Turned and then mapped is mapped and then turned. */
            CHECK(near(host.direction(engine::turned(q, v)), engine::turned(host.rotation(q), host.direction(v))));
            const quaternion back = host.host_rotation(host.rotation(q));
            CHECK(near({back[0], back[1], back[2]}, {q[0], q[1], q[2]}) && back[3] == q[3]);
        }
        for (const vector3 &w : samples) {
            /* A point v of a body that turns by w moves by w x v, and so it does in the world. */
            const vector3 moves = engine::detail::cross(w, v);
            CHECK(near(host.vector(moves), engine::detail::cross(host.turning(w), host.vector(v))));
        }
    }
}

static void unreal_is_in_centimetres_with_z_up()
{
    const auto &host = engine::unreal;
    CHECK(near(host.vector({100, 200, 300}), {1, 3, 2}));
    CHECK(near(host.extents({10, 20, 30}), {0.1f, 0.3f, 0.2f}));
    CHECK(near({host.volume(1e6f), host.length(50), 0}, {1, 0.5f, 0}));
    CHECK(near(host.host_impulse({0, 1, 0}), {0, 0, 100}));
    CHECK(near(host.host_angular_impulse({0, -1, 0}), {0, 0, 1e4f}));
    /* A quarter turn about z takes Unreal's x to y, and so the world's first axis to its third. */
    const quaternion yaw = host.rotation({0, 0, 0.70710678f, 0.70710678f});
    CHECK(near(engine::turned(yaw, {1, 0, 0}), {0, 0, 1}));
    CHECK(near(engine::unity.vector({1, 2, 3}), {1, 2, -3}) && near(engine::godot.vector({1, 2, 3}), {1, 2, 3}));
}

static void capsules_lie_along_their_axis(const engine::coordinates &host)
{
    for (int along = 0; along < 3; along++)
        for (const quaternion &turn : turns) {
            const quaternion q = engine::detail::normalised(turn);
            const pbmpm::shape shape = host.capsule({0, 0, 0}, q, 1, 2, along);
            vector3 axis{};
            axis[static_cast<std::size_t>(along)] = 1;
            const vector3 wanted = host.direction(engine::turned(q, axis));
            vector3 is = engine::turned({shape.rotation[0], shape.rotation[1], shape.rotation[2], shape.rotation[3]}, {1, 0, 0});
            /* A capsule has no front. */
            if (is[0] * wanted[0] + is[1] * wanted[1] + is[2] * wanted[2] < 0) is = {-is[0], -is[1], -is[2]};
            CHECK(near(is, wanted));
            CHECK(near({shape.half_extents[0], shape.radius, 0}, {host.length(2), host.length(1), 0}));
        }
}

static void clocks_account_for_all_time()
{
    engine::clock clock(1.0 / 60, 2);
    double seconds = 0;
    int steps = 0, most = 0;
    for (int frame = 0; frame < 1000; frame++) {
        const double frame_seconds = frame % 100 == 99 ? 0.5 : 0.001 * (frame % 37);
        seconds += frame_seconds;
        const int now = clock.advance(frame_seconds);
        steps += now;
        most = now > most ? now : most;
        CHECK(clock.debt() <= clock.dt() && clock.alpha() >= 0 && clock.alpha() <= 1);
    }
    CHECK(std::abs(steps * clock.dt() + clock.debt() + clock.lost() - seconds) < 1e-9);
    CHECK(most == 2 && clock.lost() > 4);
    const double debt = clock.debt();
    for (double bad : {-1.0, 0.0, HUGE_VAL, std::nan("")}) static_cast<void>(clock.advance(bad));
    CHECK(clock.debt() <= debt);
}

static engine::options tank(bool background)
{
    engine::options wanted;
    wanted.background = background;
    wanted.world.cell_size = 0.1f;
    wanted.world.particle_capacity = 20000;
    wanted.world.thread_count = 1;
    wanted.world.domain_enabled = 1;
    wanted.settings.gravity[1] = -9.81f;
    return wanted;
}

static std::uint32_t fill(engine::simulation &simulation, const pbmpm::shape &shape)
{
    const auto world = simulation.editing().value();
    pbmpm::fill_def fill;
    fill.material = world.material_create(pbmpm::material_def()).value();
    return world.particles_fill(fill, shape).value();
}

static std::uint64_t hash_of_a_splash(bool background)
{
    engine::simulation simulation = engine::simulation::create(tank(background)).value();
    fill(simulation, engine::unreal.box({30, 50, 50}, {0, 0, 0, 1}, {30, 40, 40}));
    pbmpm::collider_def def;
    def.kinematic = 1;
    const auto ball = simulation.editing()->collider_create(def, engine::unreal.ball({80, 50, 20}, 15)).value();
    for (int frame = 0; frame < 30; frame++) {
        simulation.follow(ball, engine::unreal.vector({80 - static_cast<float>(frame), 50, 20}), {0, 0, 0, 1});
        simulation.frame(1.0 / 59).value();
        CHECK(simulation.reading().particles_count().value() > 0);
    }
    return simulation.editing()->hash().value();
}

static void background_changes_no_result()
{
    CHECK(hash_of_a_splash(false) == hash_of_a_splash(true));
}

static vector3 place_of(engine::simulation &simulation, pbmpm_collider_id collider)
{
    const auto is = simulation.editing()->collider_get(collider).value();
    return {is.shape.position[0], is.shape.position[1], is.shape.position[2]};
}

static void followers_share_their_way_among_steps()
{
    engine::simulation simulation = engine::simulation::create(tank(false)).value();
    pbmpm::collider_def def;
    def.kinematic = 1;
    const auto ball = simulation.editing()->collider_create(def, engine::godot.ball({0.5f, 0.5f, 0.5f}, 0.1f)).value();
    simulation.follow(ball, {0.5f, 0.5f, 0.5f}, {0, 0, 0, 1});
    CHECK(simulation.frame(simulation.clock().dt()).value() == 1);
    simulation.follow(ball, {0.7f, 0.5f, 0.5f}, {0, 0, 0, 1});
    CHECK(simulation.frame(0).value() == 0);
    CHECK(near(place_of(simulation, ball), {0.5f, 0.5f, 0.5f})); /* no step yet */
    CHECK(simulation.frame(2.01 * simulation.clock().dt()).value() == 2);
    CHECK(near(place_of(simulation, ball), {0.7f, 0.5f, 0.5f}));
    /* It has arrived, so the host may put it elsewhere. */
    CHECK(simulation.editing()->collider_teleport(ball, {0.3f, 0.5f, 0.5f}));
    CHECK(simulation.frame(simulation.clock().dt()).value() == 1);
    CHECK(near(place_of(simulation, ball), {0.3f, 0.5f, 0.5f}));
    simulation.leave(ball);
    CHECK(simulation.editing()->collider_destroy(ball));
    CHECK(simulation.frame(simulation.clock().dt()).value() == 1);
    /* One that is gone, and was not left. */
    simulation.follow(ball, {0.5f, 0.5f, 0.5f}, {0, 0, 0, 1});
    const auto failed = simulation.frame(simulation.clock().dt());
    CHECK(!failed && failed.error().code == PBMPM_ERROR_INVALID_ID);
}

/* What an engine would keep of a body, in its units; falls by explicit velocities and implicit positions. */
struct host_body {
    vector3 position, velocity;
    quaternion rotation{0, 0, 0, 1};
    vector3 angular_velocity;
    float mass, inertia;
};

/* A raft of half the water's density above a tank of Unreal's. It is flat, so that it floats upright. */
struct floating_raft {
    engine::simulation simulation;
    host_body raft{{80, 80, 80}, {}, {0, 0, 0, 1}, {}, 36, 36 * (60 * 60 + 20 * 20) / 12.0f};
    pbmpm_collider_id collider{};

    static engine::options wide_tank()
    {
        engine::options wanted = tank(false);
        wanted.world.domain_max[0] = wanted.world.domain_max[2] = 1.6f;
        return wanted;
    }
    floating_raft() : simulation(engine::simulation::create(wide_tank()).value())
    {
        fill(simulation, engine::unreal.box({80, 80, 25}, {0, 0, 0, 1}, {80, 80, 25}));
        pbmpm::collider_def def;
        def.kinematic = def.measures_impulse = 1;
        def.friction_coefficient = 0;
        collider = simulation.editing()->collider_create(def, engine::unreal.box(raft.position, raft.rotation, {30, 30, 10})).value();
    }
};

constexpr int float_frames = 150;

/* Coupled to a physics engine: the heights of its centre [cm]. */
static std::vector<float> floats_in_an_engine()
{
    const auto &host = engine::unreal;
    floating_raft scene;
    host_body &raft = scene.raft;
    engine::simulation &simulation = scene.simulation;
    const auto number = simulation.add_body(engine::body(scene.collider, raft.mass)).value();
    const float dt = 1.0f / 60;
    std::vector<float> heights;
    for (int frame = 0; frame < float_frames; frame++) {
        engine::body &body = simulation.body_at(number);
        body.set_motion({host.vector(raft.position), host.rotation(raft.rotation), host.vector(raft.velocity), host.turning(raft.angular_velocity)});
        simulation.frame(simulation.clock().dt()).value();
        const engine::push push = body.take_push();
        /* Where it is now, and how it will move in the next step. */
        raft.rotation = engine::detail::turned_on(raft.rotation, raft.angular_velocity, dt);
        raft.position = engine::detail::sum(raft.position, raft.velocity, dt);
        raft.velocity = engine::detail::sum(engine::detail::sum(raft.velocity, host.host_impulse(push.linear), 1 / raft.mass), {0, 0, -981}, dt);
        raft.angular_velocity = engine::detail::sum(raft.angular_velocity, host.host_angular_impulse(push.angular), 1 / raft.inertia);
        heights.push_back(raft.position[2]);
    }
    return heights;
}

/* The same raft as a rigid body of the library's. */
static std::vector<float> floats_in_the_library()
{
    floating_raft scene;
    const auto world = scene.simulation.editing().value();
    pbmpm::rigid_def def;
    def.mass = scene.raft.mass;
    for (double &moment : def.inertia) moment = scene.raft.inertia / 1e4;
    auto state = world.rigid_begin(scene.collider, def).value();
    std::vector<float> heights;
    for (int frame = 0; frame < float_frames; frame++) {
        if (frame > 0) world.rigid_advance(scene.collider, def, state, 1.0f / 60).value(); /* the engine's raft gets its weight after the first step */
        world.step(1.0f / 60).value();
        heights.push_back(static_cast<float>(state.position[1] * 100));
    }
    return heights;
}

/* The library's yields to the water within the step, the engine's one step later, so it rocks for longer. They float at the same height, to a fifth of a cell of 10 cm: its
 * waves move it by so much for long. */
static void a_body_floats_as_high_as_the_librarys_own()
{
    const auto engines = floats_in_an_engine(), librarys = floats_in_the_library();
    double apart = 0;
    for (std::size_t i = engines.size() / 2; i < engines.size(); i++) apart += static_cast<double>(engines[i] - librarys[i]) / static_cast<double>(engines.size() / 2);
    std::printf("a raft: %.2f cm high in the end, on average %.4f cm above the library's own\n", static_cast<double>(engines.back()), apart);
    CHECK(std::abs(apart) < 2);
}

static void pushes_are_about_the_centre_of_mass()
{
    engine::simulation simulation = engine::simulation::create(tank(false)).value();
    pbmpm::collider_def def;
    def.kinematic = def.measures_impulse = 1;
    const pbmpm::shape shape = engine::godot.box({0.5f, 0.3f, 0.5f}, {0, 0, 0, 1}, {0.2f, 0.1f, 0.2f});
    const auto collider = simulation.editing()->collider_create(def, shape).value();
    const vector3 centre{0.1f, 0, 0};
    const auto number = simulation.add_body(engine::body(collider, 1e6f, centre)).value(); /* so heavy that nothing moves it */
    fill(simulation, engine::godot.box({0.5f, 0.6f, 0.5f}, {0, 0, 0, 1}, {0.2f, 0.2f, 0.2f}));
    engine::body &body = simulation.body_at(number);
    engine::motion still;
    still.position = {0.5f, 0.3f, 0.5f};
    for (int frame = 0; frame < 15; frame++) {
        body.set_motion(still);
        simulation.frame(simulation.clock().dt()).value();
        const auto impulse = simulation.editing()->collider_impulse(collider).value();
        const engine::push push = body.take_push();
        /* An impulse L about the position is L - centre x p about the centre; p is the smoothed one, hardly smoothed with such a mass. */
        const float wanted = static_cast<float>(impulse.angular[2] - 0.1 * impulse.linear[1]);
        CHECK(std::abs(push.angular[2] - wanted) < 1e-4f * (1 + std::abs(wanted)));
        if (frame == 14) CHECK(push.linear[1] < -1); /* 64 kg have landed */
    }
    CHECK(near(body.take_push().linear, {0, 0, 0})); /* taken */
    CHECK(simulation.remove_body(number));
    CHECK(!simulation.remove_body(number) && !simulation.remove_body(7));
    CHECK(!simulation.add_body(engine::body(collider, 0)));
}

static void points_are_the_hosts_and_frames_allocate_nothing()
{
    const auto &host = engine::unreal;
    engine::simulation simulation = engine::simulation::create(tank(true)).value();
    fill(simulation, host.box({50, 50, 30}, {0, 0, 0, 1}, {30, 40, 30}));
    engine::points points(host, 20000);
    simulation.frame(0.02).value();
    const long before = allocations;
    for (int frame = 0; frame < 10; frame++) {
        simulation.frame(simulation.clock().dt()).value();
        CHECK(points.copy(simulation.reading(), simulation.clock().alpha()).value().size() > 1000);
    }
    CHECK(allocations == before);
    const auto world = simulation.editing().value();
    const auto copied = points.copy(world).value();
    const auto places = world.particles_view(PBMPM_POSITION).value();
    CHECK(copied.size() == places.count);
    for (std::uint32_t i = 0; i < places.count; i += 97) {
        const vector3 place{places.at<float>(i, 0), places.at<float>(i, 1), places.at<float>(i, 2)};
        CHECK(near({copied[i].position[0], copied[i].position[1], copied[i].position[2]}, host.host_vector(place)));
    }
    engine::points small(host, 10);
    const auto refused = small.copy(world);
    CHECK(!refused && refused.error().code == PBMPM_ERROR_CAPACITY);
}

static void bad_options_are_refused()
{
    engine::options wanted = tank(false);
    wanted.dt = 0;
    CHECK(!engine::simulation::create(wanted));
    wanted.dt = std::nan("");
    CHECK(!engine::simulation::create(wanted));
    wanted = tank(false);
    wanted.most_steps = 0;
    CHECK(!engine::simulation::create(wanted));
    wanted = tank(false);
    wanted.settings.iterations = 0;
    CHECK(!engine::simulation::create(wanted));
}

int main()
{
    for (const auto &host : {engine::unreal, engine::unity, engine::godot}) {
        coordinates_keep_their_laws(host);
        capsules_lie_along_their_axis(host);
    }
    unreal_is_in_centimetres_with_z_up();
    clocks_account_for_all_time();
    background_changes_no_result();
    followers_share_their_way_among_steps();
    a_body_floats_as_high_as_the_librarys_own();
    pushes_are_about_the_centre_of_mass();
    points_are_the_hosts_and_frames_allocate_nothing();
    bad_options_are_refused();
    std::printf("%d checks, %d failures\n", checks, failures);
    return failures == 0 ? 0 : 1;
}
