#define DIM 2
#include "probes.isph"

export void rotate_all2(const uniform float f[], uniform float rotation[], uniform int count) { rotate_all(f, rotation, count); }
export void decompose_all2(const uniform float f[], uniform float u[], uniform float s[], uniform float v[], uniform int count) {
    decompose_all(f, u, s, v, count);
}
