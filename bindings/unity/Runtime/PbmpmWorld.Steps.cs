using System;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using Unity.Profiling;
using UnityEngine;

namespace Pbmpm.Components
{
    // Steps, what they cost, and the particles that they leave
    public sealed partial class PbmpmWorld
    {
        static readonly ProfilerMarker StepMarker = new ProfilerMarker("pbmpm.Step");

        StepClock clock;
        bool running;
        Stats statistics;
        int watchers;
#if ENABLE_UNITY_COLLECTIONS_CHECKS
        AtomicSafetyHandle lease;
        bool leased;
#endif

        /// <summary>Seconds of a step: of the rate, or of the preset's.</summary>
        public float StepSeconds => 1 / Mathf.Max(1e-3f, read != null ? read.RateOr(rate) : rate);

        /// <summary>Simulated time that is due [s].</summary>
        public double Debt => clock.Debt;

        /// <summary>Time that was given up since the world began, since frames took too long [s].</summary>
        public double LostTime => clock.Lost;

        /// <summary>Frames in which the step in the background was not done yet.</summary>
        public int LateFrames { get; private set; }

        /// <summary>Share of the way from the state before the last step to now, at which to draw.</summary>
        public float Alpha => clock.Alpha(StepSeconds, pace == Pace.FixedUpdate ? Time.time - Time.fixedTime : 0);

        /// <summary>What the last step cost. What goes over all particles, volume errors among it, is 0 unless someone watches.</summary>
        public Stats Statistics => statistics;

        /// <summary>Has volume errors and the like measured after each step, until <see cref="Unwatch"/>.</summary>
        public void Watch()
        {
            watchers++;
        }

        /// <summary>Ends what <see cref="Watch"/> began.</summary>
        public void Unwatch()
        {
            watchers--;
        }

        void LateUpdate()
        {
            if (pace == Pace.Frame) Advance(Time.deltaTime);
        }

        void FixedUpdate()
        {
            if (pace == Pace.FixedUpdate) Advance(Time.deltaTime);
        }

        /// <summary>Moves on by the seconds of a frame. The component does it by itself; call it for a world that is driven otherwise.</summary>
        public void Advance(float seconds)
        {
            if (simulation == null) return;
            try
            {
                clock.Add(seconds);
                if (background) AdvanceInBackground();
                else AdvanceHere();
                clock.Cut(StepSeconds);
            }
            catch (PbmpmException problem)
            {
                Stop(problem);
            }
        }

        void AdvanceHere()
        {
            Finish();
            var most = Mathf.Max(1, Mathf.RoundToInt(catchUp / StepSeconds));
            for (var steps = 0; steps < most && clock.Take(StepSeconds); steps++)
            {
                BeforeStep();
                StepMarker.Begin();
                simulation.Step(StepSeconds);
                StepMarker.End();
                AfterStep();
            }
        }

        void AdvanceInBackground()
        {
            if (running && !simulation.IsStepDone)
            {
                LateFrames++;
                return;
            }
            Finish();
            if (!clock.Take(StepSeconds)) return;
            BeforeStep();
            simulation.BeginStep(StepSeconds);
            running = true;
        }

        /// <summary>Waits for the step in the background, if there is one.</summary>
        void Finish()
        {
            if (!running) return;
            running = false;
            simulation.EndStep();
            AfterStep();
        }

        void BeforeStep()
        {
            EnterWaiting();
            if (changed) ApplySettings();
            palette.Refresh(simulation);
            for (var i = 0; i < parts.Count; i++) parts[i].BeforeStep(StepSeconds);
            EndLease();
        }

        void AfterStep()
        {
            EndLease();
            statistics = watchers > 0 ? simulation.Stats : simulation.StepStats;
            for (var i = 0; i < parts.Count; i++) parts[i].AfterStep(StepSeconds);
        }

        // Particles

        /// <summary>Number of particles; while a step runs in the background: of the state before it.</summary>
        public int ParticleCount
        {
            get
            {
                if (simulation == null) return 0;
                if (!running) EnterWaiting();
                return simulation.ParticleCount;
            }
        }

        /// <summary>Positions of all particles, as the library has them, without a copy: to be read until the next step. Jobs may read
        /// them; one that still reads when the step comes is an error, which Unity tells in the editor. They are from the world's
        /// origin, see <see cref="Outward"/>.</summary>
        public unsafe NativeArray<Vector3> Positions
        {
            get
            {
                if (ParticleCount == 0) return default(NativeArray<Vector3>);
                var view = simulation.Positions;
                if (view.Stride != sizeof(Vector3)) throw new InvalidOperationException("pbmpm: positions do not lie side by side; use Particles()");
                var array = NativeArrayUnsafeUtility.ConvertExistingDataToNativeArray<Vector3>((void*)view.Data, view.Count, Allocator.None);
#if ENABLE_UNITY_COLLECTIONS_CHECKS
                NativeArrayUnsafeUtility.SetAtomicSafetyHandle(ref array, Lease());
#endif
                return array;
            }
        }

        /// <summary>One component of a field of all particles, lent as <see cref="Positions"/> are.</summary>
        /// <param name="field">Position, velocity, or any other whose numbers are floats.</param>
        /// <param name="component">0 to 2 of vectors, 0 of single numbers.</param>
        public unsafe NativeSlice<float> Particles(Field field, int component = 0)
        {
            if (ParticleCount == 0) return default(NativeSlice<float>);
            var view = simulation.View(field);
            if (component < 0 || component >= view.Components)
                throw new ArgumentOutOfRangeException(nameof(component), "pbmpm: the field has " + view.Components + " components");
            var first = (byte*)view.Data + component * view.ComponentStride;
            var slice = NativeSliceUnsafeUtility.ConvertExistingDataToNativeSlice<float>(first, (int)view.Stride, view.Count);
#if ENABLE_UNITY_COLLECTIONS_CHECKS
            NativeSliceUnsafeUtility.SetAtomicSafetyHandle(ref slice, Lease());
#endif
            return slice;
        }

        /// <summary>Copies all particles as records for a GPU, at the time that is drawn. Returns their number.</summary>
        internal unsafe int Copy(NativeArray<ParticleRecord> records)
        {
            if (ParticleCount == 0) return 0;
            var definition = Native.CopyDef.Default;
            definition.Alpha = Alpha;
            definition.PadsVectors = 1;
            var bytes = (long)records.Length * sizeof(ParticleRecord);
            return simulation.CopyParticles((IntPtr)records.GetUnsafePtr(), bytes, definition);
        }

#if ENABLE_UNITY_COLLECTIONS_CHECKS
        AtomicSafetyHandle Lease()
        {
            if (!leased) lease = AtomicSafetyHandle.Create();
            leased = true;
            return lease;
        }
#endif

        /// <summary>What was lent shows nothing any more.</summary>
        void EndLease()
        {
#if ENABLE_UNITY_COLLECTIONS_CHECKS
            if (!leased) return;
            AtomicSafetyHandle.CheckDeallocateAndThrow(lease);
            AtomicSafetyHandle.Release(lease);
            leased = false;
#endif
        }
    }
}
