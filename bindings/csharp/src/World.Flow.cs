using Pbmpm.Native;

namespace Pbmpm
{
    // What adds, takes and drives matter
    public sealed unsafe partial class World
    {
        // Emitters

        /// <summary>Adds a source of particles; begin with <see cref="EmitterDef.Default"/>.</summary>
        public EmitterId AddEmitter(EmitterDef definition, Shape shape)
        {
            EmitterId made;
            Done(Methods.pbmpm_emitter_create(Id, &definition, &shape, &made));
            return made;
        }

        /// <summary>The definition of an emitter.</summary>
        public EmitterDef GetEmitter(EmitterId emitter)
        {
            var found = new EmitterDef { Size = (uint)sizeof(EmitterDef) };
            Done(Methods.pbmpm_emitter_get(Id, emitter, &found, null));
            return found;
        }

        /// <summary>Its shape where it stands now.</summary>
        public Shape ShapeOf(EmitterId emitter)
        {
            var found = new Shape { Size = (uint)sizeof(Shape) };
            Done(Methods.pbmpm_emitter_get(Id, emitter, null, &found));
            return found;
        }

        /// <summary>Changes an emitter; its counts stay.</summary>
        public void SetEmitter(EmitterId emitter, EmitterDef definition)
        {
            Done(Methods.pbmpm_emitter_set(Id, emitter, &definition, null));
        }

        /// <summary>Gives it another shape, or place; the rest stays.</summary>
        public void SetEmitter(EmitterId emitter, Shape shape)
        {
            Done(Methods.pbmpm_emitter_set(Id, emitter, null, &shape));
        }

        /// <summary>Where an emitter shall be at the end of the next step; its rotation stays.</summary>
        public void MoveEmitter(EmitterId emitter, Float3 position)
        {
            Done(Methods.pbmpm_emitter_move(Id, emitter, &position, null));
        }

        /// <summary>Where an emitter shall be at the end of the next step, and how it shall be turned.</summary>
        public void MoveEmitter(EmitterId emitter, Float3 position, Float4 rotation)
        {
            Done(Methods.pbmpm_emitter_move(Id, emitter, &position, &rotation));
        }

        /// <summary>What an emitter has done since it was added.</summary>
        public EmitterStatus StatusOf(EmitterId emitter)
        {
            var found = new EmitterStatus { Size = (uint)sizeof(EmitterStatus) };
            Done(Methods.pbmpm_emitter_status_get(Id, emitter, &found));
            return found;
        }

        /// <summary>Removes an emitter; its particles stay.</summary>
        public void RemoveEmitter(EmitterId emitter)
        {
            Done(Methods.pbmpm_emitter_destroy(Id, emitter));
        }

        // Drains and bounds

        /// <summary>Adds a shape that takes out the particles inside it; begin with <see cref="DrainDef.Default"/>.</summary>
        public DrainId AddDrain(DrainDef definition, Shape shape)
        {
            DrainId made;
            Done(Methods.pbmpm_drain_create(Id, &definition, &shape, &made));
            return made;
        }

        public DrainDef GetDrain(DrainId drain)
        {
            var found = new DrainDef { Size = (uint)sizeof(DrainDef) };
            Done(Methods.pbmpm_drain_get(Id, drain, &found, null));
            return found;
        }

        /// <summary>Its shape where it stands now.</summary>
        public Shape ShapeOf(DrainId drain)
        {
            var found = new Shape { Size = (uint)sizeof(Shape) };
            Done(Methods.pbmpm_drain_get(Id, drain, null, &found));
            return found;
        }

        /// <summary>Changes a drain; its counts stay.</summary>
        public void SetDrain(DrainId drain, DrainDef definition)
        {
            Done(Methods.pbmpm_drain_set(Id, drain, &definition, null));
        }

        /// <summary>Gives it another shape, or place; the rest stays.</summary>
        public void SetDrain(DrainId drain, Shape shape)
        {
            Done(Methods.pbmpm_drain_set(Id, drain, null, &shape));
        }

        /// <summary>What a drain has taken since it was added.</summary>
        public DrainStatus StatusOf(DrainId drain)
        {
            var found = new DrainStatus { Size = (uint)sizeof(DrainStatus) };
            Done(Methods.pbmpm_drain_status_get(Id, drain, &found));
            return found;
        }

        public void RemoveDrain(DrainId drain)
        {
            Done(Methods.pbmpm_drain_destroy(Id, drain));
        }

        /// <summary>The box that particles live in; those outside are taken out.</summary>
        public KillBounds KillBounds
        {
            get
            {
                var found = new KillBounds { Size = (uint)sizeof(KillBounds) };
                Done(Methods.pbmpm_world_get_kill_bounds(Id, &found));
                return found;
            }
            set => Done(Methods.pbmpm_world_set_kill_bounds(Id, &value));
        }

        /// <summary>What emitters, drains and bounds have done since the world was made.</summary>
        public Flow Flow
        {
            get
            {
                var found = new Flow { Size = (uint)sizeof(Flow) };
                Done(Methods.pbmpm_world_get_flow(Id, &found));
                return found;
            }
        }

        // Forces

        /// <summary>Adds a wind, a whirl, a push, a pull or a hand that grabs; begin with <see cref="ForceDef.Default"/>.</summary>
        public ForceId AddForce(ForceDef definition, Shape shape)
        {
            ForceId made;
            Done(Methods.pbmpm_force_create(Id, &definition, &shape, &made));
            return made;
        }

        public ForceDef GetForce(ForceId force)
        {
            var found = new ForceDef { Size = (uint)sizeof(ForceDef) };
            Done(Methods.pbmpm_force_get(Id, force, &found, null));
            return found;
        }

        /// <summary>Its shape where it stands now.</summary>
        public Shape ShapeOf(ForceId force)
        {
            var found = new Shape { Size = (uint)sizeof(Shape) };
            Done(Methods.pbmpm_force_get(Id, force, null, &found));
            return found;
        }

        /// <summary>Changes a force; takes effect with the next step.</summary>
        public void SetForce(ForceId force, ForceDef definition)
        {
            Done(Methods.pbmpm_force_set(Id, force, &definition, null));
        }

        /// <summary>Gives it another shape, or place; the rest stays.</summary>
        public void SetForce(ForceId force, Shape shape)
        {
            Done(Methods.pbmpm_force_set(Id, force, null, &shape));
        }

        /// <summary>What a force did in the last step.</summary>
        public ForceStatus StatusOf(ForceId force)
        {
            var found = new ForceStatus { Size = (uint)sizeof(ForceStatus) };
            Done(Methods.pbmpm_force_status_get(Id, force, &found));
            return found;
        }

        public void RemoveForce(ForceId force)
        {
            Done(Methods.pbmpm_force_destroy(Id, force));
        }
    }
}
