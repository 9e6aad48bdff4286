using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>An obstacle, which follows its transform and takes matter along. With a <see cref="PbmpmRigidbody"/> beside it matter
    /// pushes it, too. A jump of more than some cells is a fast motion: call <see cref="Teleport"/> after one.</summary>
    [AddComponentMenu("pbmpm/Collider")]
    public sealed class PbmpmCollider : PbmpmPart
    {
        [Tooltip("What it does to motion along its surface: Coulomb's law, holding fast, or nothing.")]
        public Friction friction = Friction.Coulomb;

        [Tooltip("Coulomb coefficient, 0 to 100.")]
        public float frictionCoefficient = 0.2f;

        [Tooltip("Whether it may move. What stays in place is cheaper.")]
        public bool moves = true;

        [Tooltip("Bit by bit, the groups of materials that it meets; 0: all.")]
        public int meets;

        [Tooltip("Whether matter passes through it: for triggers.")]
        public bool sensor;

        ColliderId id;
        PbmpmRigidbody body;
        bool jumps;

        /// <summary>Its identifier, for calls of the C# binding.</summary>
        public ColliderId Id => id;

        internal override Turn Turn => Turn.Obstacles;
        protected override Color GizmoColor => sensor ? Color.magenta : Color.green;

        /// <summary>The transform was put elsewhere: the obstacle follows at once, and throws nothing.</summary>
        public void Teleport()
        {
            jumps = true;
        }

        protected override void Add(World core, Shape at)
        {
            body = GetComponent<PbmpmRigidbody>();
            id = core.AddCollider(Definition(ColliderDef.Default), at);
        }

        protected override void Alter(World core, Shape at)
        {
            core.SetCollider(id, Definition(core.GetCollider(id)));
            core.SetCollider(id, at);
            jumps = false;
        }

        protected override void Move(World core, Shape at)
        {
            if (moves && !jumps) core.MoveCollider(id, at.Position, at.Rotation);
            else core.TeleportCollider(id, at.Position, at.Rotation);
            jumps = false;
        }

        protected override void Remove(World core)
        {
            core.RemoveCollider(id);
        }

        internal override void Aim(float seconds, ref Placement place)
        {
            if (body != null) body.Aim(seconds, ref place);
        }

        internal override void AfterStep(float seconds)
        {
            if (body == null) return;
            var at = Owner.Core.ShapeOf(id);
            body.Take(Owner.Core.ImpulseOn(id), Owner.Core.SubmersionOf(id), Owner.Outward(at.Position), seconds);
        }

        ColliderDef Definition(ColliderDef definition)
        {
            definition.Friction = friction;
            definition.FrictionCoefficient = frictionCoefficient;
            definition.Kinematic = moves ? 1 : 0;
            definition.MeasuresImpulse = body != null ? 1 : 0;
            definition.Meets = (uint)meets;
            definition.Sensor = sensor ? 1 : 0;
            return definition;
        }

        /// <summary>When it is added in the editor: as the collider that is there.</summary>
        void Reset()
        {
            var there = GetComponent<Collider>();
            if (there != null) shape.CopyFrom(there);
        }
    }
}
