#include "solvers/dual/acceleration.h"

#include <math.h>

static double next_of(double t) { return 0.5 * (1.0 + sqrt(1.0 + 4.0 * t * t)); }

Acceleration acceleration_begin(World *world)
{
    world->args.dual.momentum = 0.0f;
    return (Acceleration){world, 1.0};
}

void acceleration_next(Acceleration *acceleration, bool uphill, bool more)
{
    const double t = acceleration->t, next = next_of(t);
    acceleration->world->args.dual.momentum = uphill || !more ? 0.0f : (float)((t - 1.0) / next);
    acceleration->t = uphill ? 1.0 : next;
}

double acceleration_last(int iterations)
{
    double t = 1.0, b = 0.0;
    for (int i = 1; i < iterations; i++) {
        const double next = next_of(t);
        b = (t - 1.0) / next;
        t = next;
    }
    return b;
}

double acceleration_reached(double stiffness, int iterations)
{
    const double left = stiffness / (1.0 + stiffness);
    double t = 1.0, b = 0.0, wrong = 1.0, before = 1.0;
    for (int i = 0; i < iterations; i++) {
        const double now = left * (wrong + b * (wrong - before)), next = next_of(t);
        before = wrong;
        wrong = now;
        b = (t - 1.0) / next;
        t = next;
    }
    return 1.0 - wrong;
}
