/* pbmpm_engine: particles to draw. */
#ifndef PBMPM_ENGINE_POINTS_HPP
#define PBMPM_ENGINE_POINTS_HPP

#include "coordinates.hpp"

#include <vector>

namespace pbmpm::engine {

/** A particle as a renderer takes it: 32 bytes, {vec3, uint, vec3, uint} of GLSL's std430. */
struct point {
    float position[3];      /**< in the host's coordinates */
    std::uint32_t material; /**< index of the material's identifier */
    float velocity[3];      /**< in the host's coordinates, per second */
    std::uint32_t reserved; /**< 0 */
};
static_assert(sizeof(point) == 32);

/** Copies of a world's particles in a host's coordinates. It takes its memory once, for all particles that the world has room for. */
class points {
public:
    points(const coordinates &host, std::uint32_t capacity) : host_(host), points_(capacity) {}

    /** Copies all particles as of `alpha`, see pbmpm_copy_def; also while a step runs in the background. The result is valid until the next call.
     *  Errors: those of pbmpm_particles_copy(). */
    expected<span<const point>> copy(const world_ref &world, float alpha = 1) noexcept
    {
        static constexpr pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_MATERIAL, PBMPM_VELOCITY};
        copy_def def;
        def.stride = sizeof(point);
        def.alpha = alpha;
        def.field_count = 3;
        def.fields = fields;
        def.pads_vectors = 1;
        const auto count = world.particles_copy(def, as_writable_bytes(points_));
        if (!count) return count.error();
        for (std::uint32_t i = 0; i < *count; i++) {
            to_host(points_[i].position);
            to_host(points_[i].velocity);
        }
        return span<const point>(points_.data(), *count);
    }

private:
    void to_host(float *vector) const noexcept
    {
        const vector3 host = host_.host_vector({vector[0], vector[1], vector[2]});
        for (std::size_t i = 0; i < 3; i++) vector[i] = host[i];
    }
    coordinates host_;
    std::vector<point> points_;
};

} // namespace pbmpm::engine
#endif
