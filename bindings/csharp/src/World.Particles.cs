using System;
using Pbmpm.Native;

namespace Pbmpm
{
    public sealed unsafe partial class World
    {
        /// <summary>Number of live particles.</summary>
        public int ParticleCount
        {
            get
            {
                uint count;
                Done(Methods.pbmpm_particles_count(Id, &count));
                return (int)count;
            }
        }

        // Adding and removing

        /// <summary>Fills a shape; begin with <see cref="FillDef.Default"/>. Returns how many particles were added.</summary>
        public int Fill(FillDef definition, Shape shape)
        {
            uint added;
            Changed(Methods.pbmpm_particles_fill(Id, &definition, &shape, &added));
            return (int)added;
        }

        /// <summary>Adds particles from arrays: all of them or none.</summary>
        /// <param name="material">Their material.</param>
        /// <param name="positions">Dimension numbers per particle [m]; their number says how many particles.</param>
        /// <param name="velocities">Dimension numbers per particle [m/s]; null: at rest.</param>
        /// <param name="volumes">Rest volumes [m^d]; null: a cell has room for two particles per axis.</param>
        /// <param name="ids">Receives their identifiers; may be null.</param>
        public void AddParticles(MaterialId material, float[] positions, float[] velocities = null, float[] volumes = null,
                                 ParticleId[] ids = null)
        {
            fixed (float* place = positions, speed = velocities, volume = volumes)
            fixed (ParticleId* made = ids)
                AddParticles(material, Numbers.Plain(place, positions), Numbers.Plain(speed, velocities),
                             Numbers.Plain(volume, volumes), made, Numbers.LengthOf(ids));
        }

        void AddParticles(MaterialId material, Numbers positions, Numbers velocities, Numbers volumes, ParticleId* ids, int room)
        {
            var count = positions.Rows(nameof(positions), Dimension);
            velocities.RequireRows(nameof(velocities), Dimension, count);
            volumes.RequireRows(nameof(volumes), 1, count);
            if (room != Numbers.Missing && room != count)
                throw new ArgumentException("the length is " + room + " instead of " + count, nameof(ids));
            var definition = ParticlesDef.Default;
            definition.Material = material;
            definition.Count = (uint)count;
            definition.Volumes = volumes.Address();
            fixed (float* place = positions.Narrowed(Dimension), speed = velocities.Narrowed(Dimension))
            {
                definition.Positions = positions.Address(place);
                definition.Velocities = velocities.Address(speed);
                Changed(Methods.pbmpm_particles_add(Id, &definition, ids));
            }
        }

        /// <summary>Copies all particles to where a renderer reads them: position, velocity (Dimension floats each) and index of
        /// the material (32 bits) of one, then of the next. Also while a step runs in the background.</summary>
        /// <param name="buffer">At least ParticleCount * (2 * Dimension + 1) floats.</param>
        /// <param name="alpha">Share of the way from before the last step to now: for even motion on any display.</param>
        /// <returns>The number of particles.</returns>
        public int CopyParticles(float[] buffer, float alpha = 1)
        {
            if (buffer == null) throw new ArgumentNullException(nameof(buffer));
            fixed (float* first = buffer) return CopyParticles((IntPtr)first, (long)buffer.Length * sizeof(float), alpha);
        }

        /// <summary>The same as records, which are alike in 2D and 3D.</summary>
        /// <param name="buffer">At least ParticleCount of them.</param>
        /// <param name="alpha">Share of the way from before the last step to now.</param>
        public int CopyParticles(ParticleRecord[] buffer, float alpha = 1)
        {
            if (buffer == null) throw new ArgumentNullException(nameof(buffer));
            var definition = CopyDef.Default;
            definition.Alpha = alpha;
            definition.PadsVectors = 1;
            fixed (ParticleRecord* first = buffer) return CopyParticles((IntPtr)first, (long)buffer.Length * sizeof(ParticleRecord), definition);
        }

        /// <summary>The same into memory of the host, a mapped buffer of the GPU for one.</summary>
        public int CopyParticles(IntPtr buffer, long bytes, float alpha = 1)
        {
            var definition = CopyDef.Default;
            definition.Alpha = alpha;
            return CopyParticles(buffer, bytes, definition);
        }

        /// <summary>The same in any layout; begin with <see cref="CopyDef.Default"/>.</summary>
        public int CopyParticles(IntPtr buffer, long bytes, CopyDef definition)
        {
            uint count;
            Done(Methods.pbmpm_particles_copy(Id, &definition, buffer, (ulong)bytes, &count));
            return (int)count;
        }

        /// <summary>Removes particles; with an unknown identifier none is removed.</summary>
        public void Remove(ParticleId[] ids)
        {
            Remove(ids, Rows(ids, nameof(ids), 1));
        }

        /// <summary>Removes the first particles of a list; with an unknown identifier none is removed.</summary>
        public void Remove(ParticleId[] ids, int count)
        {
            RequireRoom(ids, nameof(ids), count);
            fixed (ParticleId* first = ids) Changed(Methods.pbmpm_particles_remove(Id, first, (uint)count));
        }

        /// <summary>Removes all particles inside a shape and says how many.</summary>
        public int RemoveIn(Shape shape)
        {
            uint removed;
            Changed(Methods.pbmpm_particles_remove_in(Id, &shape, &removed));
            return (int)removed;
        }

        // Reading and changing

        /// <summary>A window on a field of all particles; it expires with the next change.</summary>
        /// <param name="field">Any but Material, Particle and UserValue, which have properties of their own.</param>
        public FloatView View(Field field)
        {
            if (field == Field.Material || field == Field.Particle || field == Field.UserValue)
                throw new ArgumentException("this field does not hold floats; use Materials, Particles or UserValues", nameof(field));
            return new FloatView(TakeWindow(field));
        }

        /// <summary>Positions [m], relative to the origin.</summary>
        public FloatView Positions => View(Field.Position);

        /// <summary>Velocities [m/s].</summary>
        public FloatView Velocities => View(Field.Velocity);

        /// <summary>For each particle the index of its material's identifier.</summary>
        public NumberView Materials => new NumberView(TakeWindow(Field.Material));

        /// <summary>The identifiers of all particles.</summary>
        public ParticleView Particles => new ParticleView(TakeWindow(Field.Particle));

        /// <summary>Writes a field of all particles, in the order of the views.</summary>
        public void Set(Field field, float[] values)
        {
            fixed (float* first = values) Set(field, Numbers.Plain(first, values));
        }

        /// <summary>Writes a field of some particles: all or nothing.</summary>
        public void Set(Field field, ParticleId[] ids, float[] values)
        {
            fixed (ParticleId* chosen = ids)
            fixed (float* first = values)
                Set(field, chosen, Rows(ids, nameof(ids), 1), Numbers.Plain(first, values));
        }

        void Set(Field field, Numbers values)
        {
            Set(field, null, ParticleCount, values);
        }

        /// <param name="field">Which.</param>
        /// <param name="ids">Of whom; null: of all.</param>
        /// <param name="count">How many these are.</param>
        /// <param name="values">One row for each.</param>
        void Set(Field field, ParticleId* ids, int count, Numbers values)
        {
            var columns = ComponentsOf(field);
            if (!values.IsGiven) throw new ArgumentNullException(nameof(values));
            values.RequireRows(nameof(values), columns, count);
            if (count == 0) return; // the address of nothing is null, which stands for all
            fixed (float* narrow = values.Narrowed(columns))
                Changed(Methods.pbmpm_particles_set(Id, field, ids, (uint)count, (IntPtr)values.Address(narrow)));
        }

        /// <summary>For each particle the host's own number; only once a particle was given one.</summary>
        public NumberView UserValues => new NumberView(TakeWindow(Field.UserValue));

        /// <summary>Gives all particles numbers of the host's, in the order of the views.</summary>
        public void SetUserValues(uint[] values)
        {
            SetUserValues(null, ParticleCount, values);
        }

        /// <summary>Gives some particles numbers of the host's: all or nothing.</summary>
        public void SetUserValues(ParticleId[] ids, uint[] values)
        {
            fixed (ParticleId* chosen = ids) SetUserValues(chosen, Rows(ids, nameof(ids), 1), values);
        }

        void SetUserValues(ParticleId* ids, int count, uint[] values)
        {
            RequireRoom(values, nameof(values), count);
            if (values.Length != count) throw new ArgumentException("the length is " + values.Length + " instead of " + count, nameof(values));
            if (count == 0) return; // the address of nothing is null, which stands for all
            fixed (uint* first = values) Changed(Methods.pbmpm_particles_set(Id, Field.UserValue, ids, (uint)count, (IntPtr)first));
        }

        /// <summary>Where particles stand in the views of now.</summary>
        public void Find(ParticleId[] ids, uint[] rows)
        {
            var count = Rows(ids, nameof(ids), 1);
            RequireRoom(rows, nameof(rows), count);
            fixed (ParticleId* wanted = ids)
            fixed (uint* found = rows)
                Done(Methods.pbmpm_particles_find(Id, wanted, (uint)count, found));
        }

        /// <summary>Finds the particles inside a shape. Writes as many identifiers as there is room for and returns the full
        /// number.</summary>
        public int Query(Shape shape, ParticleId[] ids)
        {
            uint count;
            var room = (uint)Rows(ids, nameof(ids), 1);
            fixed (ParticleId* first = ids) Done(Methods.pbmpm_query_shape(Id, &shape, first, room, &count));
            return (int)count;
        }

        /// <summary>Finds the particles inside an obstacle; as the query of a shape.</summary>
        public int Query(ColliderId collider, ParticleId[] ids)
        {
            uint count;
            var room = (uint)Rows(ids, nameof(ids), 1);
            fixed (ParticleId* first = ids) Done(Methods.pbmpm_query_collider(Id, collider, first, room, &count));
            return (int)count;
        }

        Window TakeWindow(Field field)
        {
            var found = new View { Size = (uint)sizeof(View) };
            Done(Methods.pbmpm_particles_view(Id, field, &found));
            return new Window(this, found);
        }

        // The library gets bare pointers, so lengths are checked here

        int ComponentsOf(Field field)
        {
            switch (field)
            {
                case Field.Position:
                case Field.Velocity: return Dimension;
                case Field.AffineVelocity:
                case Field.Deformation: return Dimension * Dimension;
                default: return 1;
            }
        }

        static int Rows(Array array, string name, int columns)
        {
            if (array == null) throw new ArgumentNullException(name);
            if (array.Length % columns != 0) throw new ArgumentException("the length is no multiple of " + columns, name);
            return array.Length / columns;
        }

        static void RequireRoom(Array array, string name, int count)
        {
            if (array == null) throw new ArgumentNullException(name);
            if (count < 0 || count > array.Length)
                throw new ArgumentException("the length is " + array.Length + ", too few for " + count, name);
        }
    }

    /// <summary>What <see cref="World.CopyParticles(ParticleRecord[], float)"/> writes for each particle: 28 bytes, as a structured buffer of a GPU
    /// has them.</summary>
    public struct ParticleRecord
    {
        /// <summary>[m], relative to the origin; in 2D the third is 0.</summary>
        public Float3 Position;

        /// <summary>[m/s]</summary>
        public Float3 Velocity;

        /// <summary>Index of the material's identifier.</summary>
        public uint Material;
    }
}
