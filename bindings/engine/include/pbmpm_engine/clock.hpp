/* pbmpm_engine: steps of equal length in frames of any length. */
#ifndef PBMPM_ENGINE_CLOCK_HPP
#define PBMPM_ENGINE_CLOCK_HPP

#include <cmath>

namespace pbmpm::engine {

/** Tells how many steps a frame owes. After a slow frame it owes few: more steps would make the next frame slower still. Time that is given up is counted. */
class clock {
public:
    /** `dt`: length of a step [s], above 0; `most`: steps per frame, at least 1. Hosts check both (simulation.hpp does). */
    explicit clock(double dt = 1.0 / 60, int most = 2) noexcept : dt_(dt), most_(most) {}

    /** The steps of a frame that lasted `seconds`. A number that is negative, infinite or none counts as 0. */
    int advance(double seconds) noexcept
    {
        if (std::isfinite(seconds) && seconds > 0) debt_ += seconds;
        int steps = 0;
        for (; debt_ >= dt_ && steps < most_; steps++) debt_ -= dt_;
        if (debt_ > dt_) {
            lost_ += debt_ - dt_;
            debt_ = dt_;
        }
        return steps;
    }
    double dt() const noexcept { return dt_; }
    /** Simulated time that is due [s], at most dt. */
    double debt() const noexcept { return debt_; }
    /** Simulated time that was given up since the beginning [s]. */
    double lost() const noexcept { return lost_; }
    /** Where between the last two states to draw, from 0 to 1; see pbmpm_copy_def. */
    float alpha() const noexcept { return static_cast<float>(debt_ / dt_); }

private:
    double dt_, debt_ = 0, lost_ = 0;
    int most_;
};

} // namespace pbmpm::engine
#endif
