using System;
using System.Collections.Generic;
using Pbmpm.Components;
using UnityEngine;

namespace Pbmpm.Editing
{
    /// <summary>What the library says of a scene: advice, and how stiff each material acts. A scene that does not play is built for the
    /// time of the question.</summary>
    internal sealed class SceneTrial
    {
        public readonly List<string> Advice = new List<string>();
        public readonly Dictionary<PbmpmMaterial, Effective> Acting = new Dictionary<PbmpmMaterial, Effective>();

        public int Particles { get; private set; }

        /// <summary>What stopped it; empty when nothing did.</summary>
        public string Problem { get; private set; } = "";

        public static SceneTrial Of(PbmpmWorld world)
        {
            var trial = new SceneTrial();
            try
            {
                if (world.IsOpen) trial.Ask(world);
                else trial.Build(world);
            }
            catch (Exception problem)
            {
                trial.Problem = problem.Message;
            }
            return trial;
        }

        public static string Describe(Effective acting)
        {
            var bulk = acting.BulkModulus > 0 ? "bulk modulus " + Pascals(acting.BulkModulus) : "incompressible";
            return acting.YoungModulus > 0 ? "Young's modulus " + Pascals(acting.YoungModulus) + ", " + bulk : bulk;
        }

        void Build(PbmpmWorld world)
        {
            var entered = new List<PbmpmPart>();
            try
            {
                world.Open();
                foreach (var part in PartsOf(world))
                {
                    entered.Add(part);
                    part.EnterForTrial(world);
                }
                Ask(world);
            }
            finally
            {
                foreach (var part in entered) part.LeaveTrial();
                world.Close();
            }
        }

        void Ask(PbmpmWorld world)
        {
            var simulation = world.Simulation;
            Particles = simulation.ParticleCount;
            foreach (var note in simulation.Advice(world.StepSeconds)) Advice.Add(note.ToString());
            for (var i = 0; i < world.Colours.Count; i++)
                Acting[world.Colours.MaterialAt(i)] = simulation.EffectiveModulus(world.Colours.IdAt(i), world.StepSeconds);
        }

        /// <summary>Those that would join it, obstacles first.</summary>
        static List<PbmpmPart> PartsOf(PbmpmWorld world)
        {
            var found = new List<PbmpmPart>();
            foreach (var part in All<PbmpmPart>())
                if (part.isActiveAndEnabled && part.Find() == world)
                    found.Add(part);
            found.Sort((one, other) => one.Turn.CompareTo(other.Turn));
            return found;
        }

        /// <summary>All of a kind in the open scenes.</summary>
        internal static T[] All<T>() where T : UnityEngine.Object
        {
#if UNITY_2023_1_OR_NEWER
            return UnityEngine.Object.FindObjectsByType<T>(FindObjectsSortMode.None);
#else
            return UnityEngine.Object.FindObjectsOfType<T>();
#endif
        }

        static string Pascals(float value)
        {
            return value.ToString("G3") + " Pa";
        }
    }
}
