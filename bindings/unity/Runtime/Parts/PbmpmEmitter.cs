using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>A source of particles, which follows its transform. A tap is a disc: the shape's radius, around the local y axis.</summary>
    [AddComponentMenu("pbmpm/Emitter")]
    public sealed class PbmpmEmitter : PbmpmPart
    {
        [Tooltip("Of its particles. Needed.")]
        public PbmpmMaterial material;

        [Tooltip("Whether matter comes out of a disc of the shape's radius, in place of the whole shape.")]
        public bool disc = true;

        [Tooltip("Whether it runs now.")]
        public bool runs = true;

        [Tooltip("[m^3/s]; 0 on a disc: as much as its area and speed give.")]
        public float flow;

        [Tooltip("[m/s]")]
        public float speed = 1;

        [Tooltip("Where to, in the transform's axes.")]
        public Vector3 direction = new Vector3(0, -1, 0);

        [Tooltip("Largest angle from there [degrees], 0 to 180.")]
        public float spread;

        [Tooltip("Particles that it may make; 0: no limit.")]
        public int budget;

        [Tooltip("Particles per cell and axis, 0.25 to 16.")]
        public float particlesPerAxis = 2;

        EmitterId id;

        /// <summary>What it did so far.</summary>
        public EmitterStatus Status => IsIn ? Owner.Simulation.StatusOf(id) : default(EmitterStatus);

        internal override Turn Turn => Turn.Flows;
        protected override Color GizmoColor => material != null ? material.color : Color.white;

        protected override void Add(World core, Shape at)
        {
            id = core.AddEmitter(Definition(EmitterDef.Default, at.Radius), at);
        }

        protected override void Alter(World core, Shape at)
        {
            core.SetEmitter(id, Definition(core.GetEmitter(id), at.Radius));
            core.SetEmitter(id, at);
        }

        protected override void Move(World core, Shape at)
        {
            core.MoveEmitter(id, at.Position, at.Rotation);
        }

        protected override void Remove(World core)
        {
            core.RemoveEmitter(id);
        }

        EmitterDef Definition(EmitterDef definition, float radius)
        {
            definition.Material = Owner.IdOf(material);
            definition.Region = disc ? EmitterRegion.Disc : EmitterRegion.Volume;
            definition.Enabled = runs ? 1 : 0;
            definition.Rate = disc && flow <= 0 ? Mathf.PI * radius * radius * speed : flow;
            definition.Speed = speed;
            definition.Direction = direction;
            definition.Spread = spread * Mathf.Deg2Rad;
            definition.Budget = (ulong)Mathf.Max(0, budget);
            definition.ParticlesPerAxis = particlesPerAxis;
            return definition;
        }
    }
}
