/* Each kernel compared with the reference, on the same input: what the kernel before it left. Bounds: bounds.h. */
#ifndef PBMPM_TESTS_STAGES_H
#define PBMPM_TESTS_STAGES_H

#include "scene.h"

/* Runs the kernels of one substep with two iterations and compares what each of them wrote. */
void stages_check(Scene *scene);

/* The same for a scene of each supported instruction set, dimension and seed from 1 to `seeds`. */
void stages_check_spec(const SceneSpec *spec, int seeds);

void stages_check_scatter(Scene *scene);
void stages_check_predict(Scene *scene);
void stages_check_iterate(Scene *scene);
void stages_check_update(Scene *scene);
void stages_check_integrate(Scene *scene);

#endif
