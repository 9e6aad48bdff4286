using NUnit.Framework;
using Pbmpm.Components;

namespace Pbmpm.Tests
{
    public sealed class StepClockTests
    {
        const double Step = 1 / 60.0;

        [Test]
        public void EvenFramesTakeOneStepEach()
        {
            var clock = new StepClock();
            for (var frame = 0; frame < 600; frame++) Assert.AreEqual(1, Frame(ref clock, 1 / 60f, 2));
            Assert.AreEqual(0, clock.Lost);
        }

        [Test]
        public void UnevenFramesLoseNothing()
        {
            var clock = new StepClock();
            var steps = 0;
            for (var frame = 0; frame < 900; frame++) steps += Frame(ref clock, frame % 3 == 0 ? 0.004 : 0.01, 2);
            Assert.AreEqual(900 / 3 * 0.024 / Step, steps, 1);
            Assert.AreEqual(0, clock.Lost);
        }

        [Test]
        public void AHitchIsGivenUpAndTold()
        {
            var clock = new StepClock();
            Assert.AreEqual(2, Frame(ref clock, 1, 2));
            Assert.AreEqual(1 - 3 * Step, clock.Lost, 1e-9);
            Assert.AreEqual(Step, clock.Debt, 1e-9);
            Assert.AreEqual(1, clock.Alpha(Step), 1e-6f);
        }

        [Test]
        public void TheShareIsOneWhateverTheFrameSays()
        {
            var clock = new StepClock();
            Assert.AreEqual(0, clock.Alpha(Step, -1e-6), 0);
            Assert.AreEqual(0.5f, clock.Alpha(Step, Step / 2), 1e-6f);
            Assert.AreEqual(1, clock.Alpha(Step, 1), 0);
        }

        [Test]
        public void TimeThatRunsBackCountsAsNone()
        {
            var clock = new StepClock();
            Assert.AreEqual(0, Frame(ref clock, -1, 2));
            Assert.AreEqual(0, clock.Debt);
        }

        static int Frame(ref StepClock clock, double seconds, int catchUp)
        {
            var steps = 0;
            clock.Add(seconds);
            while (steps < catchUp && clock.Take(Step)) steps++;
            clock.Cut(Step);
            return steps;
        }
    }
}
