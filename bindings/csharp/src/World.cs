using System;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>A world of liquid and elastic matter.
    /// Units are SI, angles radians; in 2D the third component of every vector is ignored.
    /// Worlds are independent: different ones may step at the same time on different threads. Calls that only read share a
    /// world; one that changes it gets <see cref="Result.ErrorBusy"/> while another thread is inside a call. No call makes
    /// garbage, except those that throw, that make an array or, in 2D, that take vectors.
    /// Dispose of a world to release its memory at once; one that is forgotten is destroyed when it is collected, or with its
    /// domain or process at the latest.</summary>
    public sealed unsafe partial class World : IDisposable
    {
        /// <summary>No view has it: they start low and count up.</summary>
        const ulong NoGeneration = ulong.MaxValue;

        WorldId id;
        ulong generation = NoGeneration;
        ulong published = NoGeneration, publishedBefore = NoGeneration; // of the last two begins, whose views stay readable
        Event[] events = new Event[0];

        /// <summary>Makes a world; begin with <see cref="WorldDef.Default"/> and change what differs.</summary>
        /// <exception cref="LibraryException">The native library is missing or does not fit.</exception>
        /// <exception cref="PbmpmException">The definition is refused, or there is no memory.</exception>
        /// <param name="definition">What it is made of.</param>
        /// <param name="tasks">The host's job system; null: threads of the world's own. Kept as long as the world.</param>
        /// <param name="memory">The host's memory; null: the C library's. Kept as long as the world.</param>
        public World(WorldDef definition, HostTasks tasks = null, HostMemory memory = null)
        {
            Library.Check();
            id = LiveWorlds.Create(definition, tasks, memory);
            Dimension = definition.Dimension;
            NoteGeneration();
        }

        /// <summary>A world that nobody refers to any more. No call of it can be under way: see <see cref="Done"/>.</summary>
        ~World()
        {
            if (!IsDisposed) LiveWorlds.Destroy(id);
        }

        /// <summary>Destroys the world; views of it expire. A second call does nothing.</summary>
        /// <exception cref="PbmpmException">Another thread is inside a call; the world is still there.</exception>
        public void Close()
        {
            Library.Require(Destroy());
        }

        /// <summary>As <see cref="Close"/>, but never throws, so that it hides no exception on whose way it is called. A world that
        /// another thread is inside of stays, see <see cref="IsDisposed"/>: dispose of it again, or it goes when it is
        /// collected.</summary>
        public void Dispose()
        {
            Destroy();
        }

        Result Destroy()
        {
            if (IsDisposed) return Result.Ok;
            var result = LiveWorlds.Destroy(id);
            GC.KeepAlive(this);
            if (result != Result.Ok) return result;
            id = default(WorldId);
            generation = published = publishedBefore = NoGeneration;
            GC.SuppressFinalize(this);
            return result;
        }

        public bool IsDisposed => id.Generation == 0;

        /// <summary>The identifier, for the functions in <see cref="Methods"/>. Views do not notice what those change;
        /// use GC.KeepAlive(world) after them.</summary>
        /// <exception cref="ObjectDisposedException"/>
        public WorldId Id
        {
            get
            {
                if (IsDisposed) throw new ObjectDisposedException(nameof(World));
                return id;
            }
        }

        /// <summary>2 or 3.</summary>
        public int Dimension { get; }

        /// <summary>What the world was made from.</summary>
        public WorldDef Definition
        {
            get
            {
                var found = new WorldDef { Size = (uint)sizeof(WorldDef) };
                Done(Methods.pbmpm_world_get_def(Id, &found));
                return found;
            }
        }

        /// <summary>What may change between steps; takes effect with the next one.</summary>
        public Settings Settings
        {
            get
            {
                var found = new Settings { Size = (uint)sizeof(Settings) };
                Done(Methods.pbmpm_world_get_settings(Id, &found));
                return found;
            }
            set => Done(Methods.pbmpm_world_set_settings(Id, &value));
        }

        /// <summary>Advances the world by <paramref name="seconds"/>, in (0, 10], in as many parts as the settings say.</summary>
        public void Step(float seconds)
        {
            Changed(Methods.pbmpm_world_step(Id, seconds));
        }

        /// <summary>What the last step cost and the state that it left; goes over all particles, on the world's threads.</summary>
        public Stats Stats
        {
            get
            {
                var found = new Stats { Size = (uint)sizeof(Stats) };
                Done(Methods.pbmpm_world_get_stats(Id, &found));
                return found;
            }
        }

        /// <summary>What the last step cost, without the state that it left: mass, momenta, energies, volume errors, the largest speed and
        /// lane occupancy are 0. Costs nothing; also while a step runs in the background: then of the step before it.</summary>
        public Stats StepStats
        {
            get
            {
                var found = new Stats { Size = (uint)sizeof(Stats) };
                Done(Methods.pbmpm_world_get_step_stats(Id, &found));
                return found;
            }
        }

        /// <summary>Events of the last step and of calls since then. They share one array: for one thread at a time.</summary>
        public EventList Events
        {
            get
            {
                uint count, missed;
                Done(Methods.pbmpm_world_events(Id, null, 0, &count, &missed));
                if (events.Length < count) events = new Event[Constants.MaxEvents];
                if (count > 0) events[0].Size = (uint)sizeof(Event);
                fixed (Event* first = events) Done(Methods.pbmpm_world_events(Id, first, count, &count, &missed));
                return new EventList(this, events, (int)count, missed);
            }
        }

        /// <summary>Hash of the dynamic state in storage order. Equal for the same calls on the same binary and
        /// instruction set, for any number of threads.</summary>
        public ulong StateHash
        {
            get
            {
                ulong hash;
                Done(Methods.pbmpm_world_hash(Id, &hash));
                return hash;
            }
        }

        // Materials

        /// <summary>Adds a material; begin with <see cref="MaterialDef.Default"/>.</summary>
        public MaterialId AddMaterial(MaterialDef definition)
        {
            MaterialId made;
            Done(Methods.pbmpm_material_create(Id, &definition, &made));
            return made;
        }

        public MaterialDef GetMaterial(MaterialId material)
        {
            var found = new MaterialDef { Size = (uint)sizeof(MaterialDef) };
            Done(Methods.pbmpm_material_get(Id, material, &found));
            return found;
        }

        /// <summary>How stiff the material is when the world is stepped by <paramref name="seconds"/> with its present
        /// settings.</summary>
        public Effective EffectiveModulus(MaterialId material, float seconds)
        {
            var found = new Effective { Size = (uint)sizeof(Effective) };
            Done(Methods.pbmpm_material_effective(Id, material, seconds, &found));
            return found;
        }

        /// <summary>Changes the parameters of a material (not its kind or density).</summary>
        public void SetMaterial(MaterialId material, MaterialDef definition)
        {
            Done(Methods.pbmpm_material_set(Id, material, &definition));
        }

        /// <summary>Removes a material that no particle uses.</summary>
        public void RemoveMaterial(MaterialId material)
        {
            Done(Methods.pbmpm_material_destroy(Id, material));
        }

        // Obstacles

        /// <summary>Adds an obstacle; begin with <see cref="ColliderDef.Default"/>. It may stand on top of matter: that is
        /// pushed out over the next steps.</summary>
        public ColliderId AddCollider(ColliderDef definition, Shape shape)
        {
            ColliderId made;
            Done(Methods.pbmpm_collider_create(Id, &definition, &shape, &made));
            return made;
        }

        /// <summary>The definition of an obstacle.</summary>
        public ColliderDef GetCollider(ColliderId collider)
        {
            var found = new ColliderDef { Size = (uint)sizeof(ColliderDef) };
            Done(Methods.pbmpm_collider_get(Id, collider, &found, null));
            return found;
        }

        /// <summary>Its shape where it stands now.</summary>
        public Shape ShapeOf(ColliderId collider)
        {
            var found = new Shape { Size = (uint)sizeof(Shape) };
            Done(Methods.pbmpm_collider_get(Id, collider, null, &found));
            return found;
        }

        /// <summary>Changes an obstacle, which keeps its place and its identifier.</summary>
        public void SetCollider(ColliderId collider, ColliderDef definition)
        {
            Done(Methods.pbmpm_collider_set(Id, collider, &definition, null));
        }

        /// <summary>Gives it another shape, or place, at once and without velocity; the rest stays.</summary>
        public void SetCollider(ColliderId collider, Shape shape)
        {
            Done(Methods.pbmpm_collider_set(Id, collider, null, &shape));
        }

        public void RemoveCollider(ColliderId collider)
        {
            Done(Methods.pbmpm_collider_destroy(Id, collider));
        }

        /// <summary>Where a kinematic obstacle shall be at the end of the next step; its rotation stays.</summary>
        public void MoveCollider(ColliderId collider, Float3 position)
        {
            Done(Methods.pbmpm_collider_move(Id, collider, &position, null));
        }

        /// <summary>Where a kinematic obstacle shall be at the end of the next step, and how it shall be turned.</summary>
        public void MoveCollider(ColliderId collider, Float3 position, Float4 rotation)
        {
            Done(Methods.pbmpm_collider_move(Id, collider, &position, &rotation));
        }

        /// <summary>Puts an obstacle, static ones too, somewhere at once, without velocity; its rotation stays.</summary>
        public void TeleportCollider(ColliderId collider, Float3 position)
        {
            Done(Methods.pbmpm_collider_teleport(Id, collider, &position, null));
        }

        /// <summary>Puts and turns an obstacle, static ones too, at once, without velocity.</summary>
        public void TeleportCollider(ColliderId collider, Float3 position, Float4 rotation)
        {
            Done(Methods.pbmpm_collider_teleport(Id, collider, &position, &rotation));
        }

        // What every call ends with

        /// <summary>Throws unless the call went well. It reads this object after the call, so the collector cannot take the
        /// world away while the library works on it.</summary>
        void Done(Result result)
        {
            GC.KeepAlive(this);
            Library.Require(result);
        }

        /// <summary>As <see cref="Done"/>, for calls that may have expired views, also when they failed.</summary>
        void Changed(Result result)
        {
            var problem = result == Result.Ok ? null : Library.Problem(result);
            NoteGeneration();
            if (problem != null) throw problem;
        }

        /// <summary>Asks once per change, so that a view can compare numbers instead of calling the library for every
        /// element.</summary>
        void NoteGeneration()
        {
            ulong now;
            generation = Methods.pbmpm_world_generation(id, &now) == Result.Ok ? now : NoGeneration;
            GC.KeepAlive(this);
        }

        internal bool IsCurrent(ulong viewGeneration)
        {
            if (viewGeneration == NoGeneration) return false;
            return viewGeneration == generation || viewGeneration == published || viewGeneration == publishedBefore;
        }

        internal ulong Generation => generation;
    }
}
