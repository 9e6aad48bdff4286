using System;
using System.Runtime.InteropServices;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>One thing that a scene and its settings do not hold: see <see cref="AdviceCode"/> for what its figures are of.</summary>
    public sealed class AdviceNote
    {
        public readonly AdviceCode Code;

        /// <summary>One sentence.</summary>
        public readonly string Text;

        /// <summary>Whose; all zero: of no material.</summary>
        public readonly MaterialId Material;

        /// <summary>Whose; all zero: of no obstacle.</summary>
        public readonly ColliderId Collider;

        /// <summary>What was found.</summary>
        public readonly float Figure;

        /// <summary>What it would have to keep to.</summary>
        public readonly float Bound;

        /// <summary>What would help.</summary>
        public readonly Change Change;

        /// <summary>To what.</summary>
        public readonly float Value;

        /// <summary>What that costs, in percent of a step; negative: not known.</summary>
        public readonly float Price;

        /// <summary>Whether it was measured in the present state; else it is foreseen.</summary>
        public readonly bool CameTrue;

        internal AdviceNote(Native.Advice found)
        {
            Code = found.Code;
            Text = Marshal.PtrToStringAnsi(found.Text);
            Material = found.Material;
            Collider = found.Collider;
            Figure = found.Figure;
            Bound = found.Bound;
            Change = found.Change;
            Value = found.Value;
            Price = found.Price;
            CameTrue = found.CameTrue != 0;
        }

        /// <summary>Unit of Figure and Bound; empty where they have none.</summary>
        public string Unit
        {
            get { return Marshal.PtrToStringAnsi(Methods.pbmpm_advice_unit(Code)); }
        }

        public override string ToString()
        {
            string unit = Unit.Length > 0 ? " " + Unit : "";
            string wanted = Code == AdviceCode.Ignored ? "default" : Figure >= Bound ? "should be at most" : "should be at least";
            string remedy = Change == Change.None ? "" : string.Format("; would help: {0} {1:G3}", Change, Value);
            string numbers = Figure == 0.0f && Bound == 0.0f ? "" : string.Format(" ({0:G3}{1}; {2} {3:G3}{1})", Figure, unit, wanted, Bound);
            return Text + numbers + remedy;
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>What the scene and settings of now will not hold when the world is stepped by dt [s], and what came true so far. Changes nothing.</summary>
        public AdviceNote[] Advice(float dt)
        {
            uint count;
            Done(Methods.pbmpm_world_advice(Id, dt, null, 0, &count));
            var room = new Native.Advice[Math.Max(1u, count)];
            room[0].Size = (uint)sizeof(Native.Advice);
            fixed (Native.Advice* first = room) Done(Methods.pbmpm_world_advice(Id, dt, first, count, &count));
            var notes = new AdviceNote[count];
            for (var i = 0; i < notes.Length; i++) notes[i] = new AdviceNote(room[i]);
            return notes;
        }
    }
}
