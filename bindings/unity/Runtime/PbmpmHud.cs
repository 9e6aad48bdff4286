using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Shows what a world costs and how well it does. It makes no garbage. Volume errors take a pass over all particles.</summary>
    [AddComponentMenu("pbmpm/HUD")]
    public sealed class PbmpmHud : MonoBehaviour
    {
        const float Left = 10, Top = 10, Line = 18, Width = 300, Digit = 9, Column = 150;

        [Tooltip("None: the first of the scene.")]
        public PbmpmWorld world;

        static readonly string[] Digits = { "0", "1", "2", "3", "4", "5", "6", "7", "8", "9" };

        PbmpmWorld watched;
        int row;

        void OnEnable()
        {
            useGUILayout = false;
        }

        void OnDisable()
        {
            Watch(null);
        }

        void OnGUI()
        {
            Watch(world != null ? world : PbmpmWorld.First);
            if (watched == null || UnityEngine.Event.current.type != EventType.Repaint) return;
            row = 0;
            var now = watched.Statistics;
            Show("particles", now.ParticleCount, 0, "");
            Show("step", now.MsTotal, 2, "ms");
            Show("predicted error", now.PredictedError, 4, "cells");
            Show("volume error, rms", now.VolumeErrorRms * 100, 2, "%");
            Show("debt", watched.Debt * 1000, 1, "ms");
            Show("given up", watched.LostTime, 2, "s");
        }

        void Watch(PbmpmWorld other)
        {
            if (other == watched) return;
            if (watched != null) watched.Unwatch();
            if (other != null) other.Watch();
            watched = other;
        }

        void Show(string name, double value, int decimals, string unit)
        {
            var y = Top + Line * row++;
            GUI.Label(new Rect(Left, y, Column, Line), name);
            var x = Number(Left + Column, y, value, decimals);
            GUI.Label(new Rect(x + Digit, y, Width, Line), unit);
        }

        /// <summary>Digit by digit: a text for the whole number would be garbage. Returns where it ends.</summary>
        static float Number(float x, float y, double value, int decimals)
        {
            var scale = 1L;
            for (var i = 0; i < decimals; i++) scale *= 10;
            var rest = (long)(System.Math.Max(0, value) * scale + 0.5);
            var unit = scale;
            while (rest / unit >= 10) unit *= 10;
            for (; unit > 0; unit /= 10)
            {
                GUI.Label(new Rect(x, y, Line, Line), Digits[rest / unit % 10]);
                x += Digit;
                if (unit != scale || decimals == 0) continue;
                GUI.Label(new Rect(x, y, Line, Line), ".");
                x += Digit / 2;
            }
            return x;
        }
    }
}
