/* How tests of many kinds go: 60 steps a second, from rest. */
#ifndef PBMPM_TESTS_API_PACE_H
#define PBMPM_TESTS_API_PACE_H

static const float DT = 1.0f / 60, STILL[3] = {0};

#endif
