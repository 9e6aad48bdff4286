using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>A wind, a whirl, a push, a pull, or a hand that grabs. It follows its transform.</summary>
    [AddComponentMenu("pbmpm/Force")]
    public sealed class PbmpmForce : PbmpmPart
    {
        [Tooltip("Uniform and radial push, vortex whirls, drag is a wind or a brake, grab takes matter along.")]
        public ForceKind kind = ForceKind.Uniform;

        [Tooltip("Whether it acts now.")]
        public bool acts = true;

        [Tooltip("Whether it acts in all the world. The shape then only gives the centre.")]
        public bool everywhere;

        [Tooltip("How it fades outside of the shape.")]
        public Falloff falloff = Falloff.None;

        [Tooltip("How far it reaches beyond the shape [m].")]
        public float range;

        [Tooltip("Acceleration [m/s^2]. Drag: [1/s]. Grab: not used.")]
        public float strength = 1;

        [Tooltip("Uniform: of the acceleration. Vortex, drag and grab: the axis. In the transform's axes.")]
        public Vector3 direction = new Vector3(0, 1, 0);

        [Tooltip("Drag and grab: where matter is taken to [m/s].")]
        public Vector3 velocity;

        [Tooltip("Drag and grab: turns about the axis [degrees/s].")]
        public float spin;

        ForceId id;

        /// <summary>What it did in the last step.</summary>
        public ForceStatus Status => IsIn ? Owner.Simulation.StatusOf(id) : default(ForceStatus);

        internal override Turn Turn => Turn.Flows;
        protected override Color GizmoColor => Color.yellow;

        protected override void Add(World core, Shape at)
        {
            id = core.AddForce(Definition(ForceDef.Default), at);
        }

        protected override void Alter(World core, Shape at)
        {
            core.SetForce(id, Definition(core.GetForce(id)));
            core.SetForce(id, at);
        }

        protected override void Remove(World core)
        {
            core.RemoveForce(id);
        }

        ForceDef Definition(ForceDef definition)
        {
            definition.Kind = kind;
            definition.Enabled = acts ? 1 : 0;
            definition.Everywhere = everywhere ? 1 : 0;
            definition.Falloff = falloff;
            definition.Range = range;
            definition.Strength = strength;
            definition.Direction = transform.rotation * direction;
            definition.Velocity = velocity;
            definition.Spin = spin * Mathf.Deg2Rad;
            return definition;
        }
    }
}
