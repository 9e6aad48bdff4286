/* pour: a jet of water fills a tank for two seconds, from C++. With an installed library:
 * c++ -std=c++17 pour.cpp $(pkg-config --cflags --libs pbmpm) && ./a.out */
#include <pbmpm/pbmpm.hpp>

static pbmpm::expected<pbmpm::world> make_tank()
{
    pbmpm::world_def def;
    def.domain_enabled = 1; /* 1 m wide */
    def.cell_size = 0.05f;
    auto tank = pbmpm::world::create(def);
    if (!tank) return tank;
    pbmpm::settings settings;
    settings.gravity[1] = -9.81f;
    if (auto set = tank->set_settings(settings); !set) return set.error();
    return tank;
}

static pbmpm::expected<pbmpm_emitter_id> add_jet(const pbmpm::world &tank)
{
    const auto water = tank.material_create(pbmpm::material_def());
    if (!water) return water.error();
    pbmpm::emitter_def jet;
    pbmpm::shape nozzle;
    jet.material = *water;
    jet.region = PBMPM_EMIT_DISC;
    jet.speed = 2;
    jet.rate = 0.2f; /* m^3/s */
    nozzle.radius = 0.18f;
    nozzle.position[0] = nozzle.position[2] = 0.5f;
    nozzle.position[1] = 0.9f;
    return tank.emitter_create(jet, nozzle);
}

int main()
{
    const pbmpm::world tank = make_tank().value();
    const pbmpm_emitter_id jet = add_jet(tank).value();
    const std::array<float, 6> corners{{0.2f, 0, 0.2f, 0.8f, 0, 0.8f}};
    std::array<float, 2> levels{};
    for (int frame = 1; frame <= 120; frame++) {
        tank.step(1.0f / 60).value();
        if (frame % 30 != 0) continue;
        tank.query_heights(corners, levels).value();
        const pbmpm_emitter_status status = tank.emitter_status_get(jet).value();
        std::printf("%.1f s: %.0f kg, levels %.2f m and %.2f m\n", frame / 60.0, status.emitted_mass, static_cast<double>(levels[0]),
                    static_cast<double>(levels[1]));
    }
    return 0;
}
