using System;

namespace Pbmpm.Components
{
    /// <summary>Turns the uneven seconds of frames into steps of one length. What is due and was not yet simulated is the debt. What
    /// exceeds one step after a frame is given up, and counted: catching up would make the next frame longer still.</summary>
    public struct StepClock
    {
        /// <summary>Simulated time that is due [s].</summary>
        public double Debt { get; private set; }

        /// <summary>Time that was given up so far [s].</summary>
        public double Lost { get; private set; }

        /// <summary>Adds the seconds of a frame; less than nothing counts as nothing.</summary>
        public void Add(double seconds)
        {
            if (seconds > 0) Debt += seconds;
        }

        /// <summary>Whether a step of these seconds is due; then it is paid for.</summary>
        public bool Take(double step)
        {
            // Sums of frames miss a whole step by rounding: a thousandth of one is no reason to wait a frame
            if (Debt < step * 0.999) return false;
            Debt = Math.Max(0, Debt - step);
            return true;
        }

        /// <summary>At the end of a frame: gives up what exceeds one step.</summary>
        public void Cut(double step)
        {
            if (Debt <= step) return;
            Lost += Debt - step;
            Debt = step;
        }

        /// <summary>Share of the way from the state before the last step to now, at which to draw: 0 to 1.</summary>
        /// <param name="step">Seconds of a step.</param>
        /// <param name="since">Seconds of the frame that were not added yet.</param>
        public float Alpha(double step, double since = 0)
        {
            return (float)Math.Max(0, Math.Min(1, (Debt + since) / step));
        }
    }
}
