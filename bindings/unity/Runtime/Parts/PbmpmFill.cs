using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Matter that is there when the world begins, and once more whenever this is enabled anew. Obstacles keep it out. When it
    /// is disabled its particles stay.</summary>
    [AddComponentMenu("pbmpm/Fill")]
    public sealed class PbmpmFill : PbmpmPart
    {
        [Tooltip("Of its particles. Needed.")]
        public PbmpmMaterial material;

        [Tooltip("Of every particle [m/s], in the transform's axes.")]
        public Vector3 velocity;

        [Tooltip("Particles per cell and axis, 0.25 to 16.")]
        public float particlesPerAxis = 2;

        [Tooltip("Equal seeds give equal particles.")]
        public int seed = 1;

        /// <summary>Particles that it made the last time.</summary>
        public int Added { get; private set; }

        internal override Turn Turn => Turn.Matter;
        protected override Color GizmoColor => material != null ? material.color : Color.white;

        protected override void Add(World core, Shape at)
        {
            var definition = FillDef.Default;
            definition.Material = Owner.IdOf(material);
            definition.Velocity = transform.rotation * velocity;
            definition.ParticlesPerAxis = particlesPerAxis;
            definition.Seed = (uint)seed;
            Added = core.Fill(definition, at);
        }

        protected override void Remove(World core)
        {
        }
    }
}
