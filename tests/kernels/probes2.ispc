#define DIM 2
#include "probes.isph"

export void rotate_all2(const uniform float f[], uniform float rotation[], uniform int count) { rotate_all(f, rotation, count); }
export void decompose_all2(const uniform float f[], uniform float u[], uniform float s[], uniform float v[], uniform int count) {
    decompose_all(f, u, s, v, count);
}

export void stress_all2(const uniform struct KernelMaterial *uniform material, const uniform float f[], const uniform float d[],
                        const uniform float y[], uniform float s[], uniform int count) {
    stress_all(material, f, d, y, s, count);
}
export void pressure_all2(const uniform struct KernelMaterial *uniform material, const uniform float ratio[], const uniform float second[],
                          const uniform float trace[], const uniform float y[], uniform float s[], uniform int count) {
    pressure_all(material, ratio, second, trace, y, s, count);
}
export void energy_all2(const uniform struct KernelMaterial *uniform material, const uniform float f[], const uniform float d[],
                        uniform float stress[], uniform float energy[], uniform int count) {
    energy_all(material, f, d, stress, energy, count);
}
export void close_all2(const uniform float d[], uniform float stress[], uniform float energy[], uniform int count) {
    close_all(d, stress, energy, count);
}
export void yield_all2(const uniform struct KernelMaterial *uniform material, const uniform float before[], uniform float after[],
                       uniform int count) {
    yield_all(material, before, after, count);
}
export void give_up_all2(const uniform struct KernelMaterial *uniform material, const uniform float room[], const uniform float before[],
                         uniform float after[], uniform int count) {
    give_up_all(material, room, before, after, count);
}
export void close_voids_all2(const uniform struct KernelMaterial *uniform material, const uniform float room[], const uniform float before[],
                         uniform float after[], uniform int count) {
    close_voids_all(material, room, before, after, count);
}
export void cut_all2(const uniform struct KernelMaterial *uniform material, const uniform float before[], uniform float after[], uniform int count) {
    cut_all(material, before, after, count);
}
