using System;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>An obstacle that moves as matter, gravity and the host push it. Advance it once before each step of its world.</summary>
    public sealed unsafe class RigidBody
    {
        readonly World world;

        /// <summary>What it is. The host may change it from step to step, for instance its force and torque.</summary>
        public RigidDef Definition;

        /// <summary>How it is and moves. The host may set velocities, and copies it to go back to it.</summary>
        public RigidState State;

        /// <summary>Its obstacle.</summary>
        public ColliderId Collider { get; }

        /// <summary>A body at rest where its obstacle is; that is kinematic, measures its impulse, and is no plane.</summary>
        public RigidBody(World world, ColliderId collider, RigidDef definition)
        {
            this.world = world ?? throw new ArgumentNullException(nameof(world));
            Collider = collider;
            Definition = definition;
            State = world.BeginRigid(collider, definition);
        }

        /// <summary>Moves the body on and sends its obstacle there.</summary>
        /// <param name="seconds">As for the step that follows.</param>
        public void Advance(float seconds)
        {
            State = world.AdvanceRigid(Collider, Definition, State, seconds);
        }

        /// <summary>A definition with the mass properties of a shape.</summary>
        public static RigidDef Of(MassProperties mass)
        {
            var definition = RigidDef.Default;
            definition.Mass = mass.Mass;
            definition.Centre = mass.Centre;
            definition.Inertia = mass.Inertia;
            definition.Products = mass.Products;
            return definition;
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>The mass properties of a shape at a density [kg/m^3].</summary>
        public MassProperties MassOf(Shape shape, float density)
        {
            var found = new MassProperties { Size = (uint)sizeof(MassProperties) };
            Done(Methods.pbmpm_shape_mass(Id, &shape, density, &found));
            return found;
        }

        /// <summary>The part of an obstacle that is under matter.</summary>
        public Submersion SubmersionOf(ColliderId collider)
        {
            var found = new Submersion { Size = (uint)sizeof(Submersion) };
            Done(Methods.pbmpm_collider_submerged(Id, collider, null, &found));
            return found;
        }

        /// <summary>The part of an obstacle that is under one material.</summary>
        public Submersion SubmersionOf(ColliderId collider, MaterialId material)
        {
            var found = new Submersion { Size = (uint)sizeof(Submersion) };
            Done(Methods.pbmpm_collider_submerged(Id, collider, &material, &found));
            return found;
        }

        internal RigidState BeginRigid(ColliderId collider, RigidDef definition)
        {
            var state = new RigidState { Size = (uint)sizeof(RigidState) };
            Done(Methods.pbmpm_rigid_begin(Id, collider, &definition, &state));
            return state;
        }

        internal RigidState AdvanceRigid(ColliderId collider, RigidDef definition, RigidState state, float seconds)
        {
            Done(Methods.pbmpm_rigid_advance(Id, collider, &definition, &state, seconds));
            return state;
        }
    }
}
