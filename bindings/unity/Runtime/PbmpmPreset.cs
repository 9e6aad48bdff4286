using System;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Reads a preset that `pbmpm tune` wrote: low.json, medium.json or high.json, as a text asset.</summary>
    [Serializable]
    internal sealed class PbmpmPreset
    {
        /// <summary>A number that the file does not give: the world keeps its own.</summary>
        const float Absent = -1;

        // JsonUtility fills fields of these names, and keeps what the file does not give
        public string format = "";
        public int version = 0;
        public Changes settings = new Changes();

        [Serializable]
        internal sealed class Changes
        {
            public float rate_hz = Absent;
            public int substeps = (int)Absent;
            public int iterations = (int)Absent;
            public string solver = "";
            public string pressure = "";
            public string integrator = "";
            public float flip = Absent;
            public float target_error = Absent;
            public float time_budget_ms = Absent;
        }

        /// <exception cref="FormatException">It is no preset, or of another version, or has a word that is not known.</exception>
        public static PbmpmPreset Read(TextAsset file)
        {
            var read = JsonUtility.FromJson<PbmpmPreset>(file.text);
            if (read == null || read.format != "pbmpm-preset") throw new FormatException("pbmpm: '" + file.name + "' is no preset of 'pbmpm tune'");
            if (read.version != 1) throw new FormatException("pbmpm: '" + file.name + "' is a preset of version " + read.version + ", not 1");
            return read;
        }

        public float RateOr(float rate)
        {
            return settings.rate_hz > 0 ? settings.rate_hz : rate;
        }

        public void Apply(ref Settings target)
        {
            if (settings.substeps > 0) target.Substeps = settings.substeps;
            if (settings.iterations > 0) target.Iterations = settings.iterations;
            if (settings.flip >= 0) target.Flip = settings.flip;
            if (settings.target_error >= 0) target.TargetError = settings.target_error;
            if (settings.time_budget_ms >= 0) target.TimeBudgetMs = settings.time_budget_ms;
            target.Solver = Word(settings.solver, target.Solver);
            target.Pressure = Word(settings.pressure, target.Pressure);
            target.Integrator = Word(settings.integrator, target.Integrator);
        }

        /// <summary>The member of that name, which the file writes in small letters.</summary>
        static T Word<T>(string word, T otherwise) where T : struct
        {
            if (string.IsNullOrEmpty(word)) return otherwise;
            T found;
            if (!Enum.TryParse(word, true, out found)) throw new FormatException("pbmpm: a preset has the unknown word '" + word + "'");
            return found;
        }
    }
}
