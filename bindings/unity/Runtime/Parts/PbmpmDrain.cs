using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Takes out the particles inside it. It follows its transform.</summary>
    [AddComponentMenu("pbmpm/Drain")]
    public sealed class PbmpmDrain : PbmpmPart
    {
        [Tooltip("What it takes. None: everything.")]
        public PbmpmMaterial material;

        [Tooltip("Whether it is open now.")]
        public bool open = true;

        DrainId id;

        /// <summary>What it took so far.</summary>
        public DrainStatus Status => IsIn ? Owner.Simulation.StatusOf(id) : default(DrainStatus);

        internal override Turn Turn => Turn.Flows;
        protected override Color GizmoColor => Color.red;

        protected override void Add(World core, Shape at)
        {
            id = core.AddDrain(Definition(DrainDef.Default), at);
        }

        protected override void Alter(World core, Shape at)
        {
            core.SetDrain(id, Definition(core.GetDrain(id)));
            core.SetDrain(id, at);
        }

        protected override void Move(World core, Shape at)
        {
            core.SetDrain(id, at);
        }

        protected override void Remove(World core)
        {
            core.RemoveDrain(id);
        }

        DrainDef Definition(DrainDef definition)
        {
            definition.Enabled = open ? 1 : 0;
            definition.Material = material != null ? Owner.IdOf(material) : default(MaterialId);
            return definition;
        }
    }
}
