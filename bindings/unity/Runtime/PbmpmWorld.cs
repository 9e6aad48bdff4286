using System;
using System.Collections.Generic;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Where a world takes its steps.</summary>
    public enum Pace
    {
        /// <summary>Once a frame, as many steps as are due, after scripts and animations have moved things.</summary>
        Frame,
        /// <summary>With the physics: for rigid bodies that matter pushes.</summary>
        FixedUpdate,
    }

    /// <summary>A world of liquid, elastic bodies, sand and clay. Parts (fills, colliders and the others) join the world above them, or the
    /// first one of the scene. Its box stands around its transform. It stays where it was when the world began, and is not turned.
    /// The world begins when the component is enabled, and ends when it is disabled: with the play mode, the scene or the scripts.</summary>
    [DefaultExecutionOrder(-100), DisallowMultipleComponent, AddComponentMenu("pbmpm/World")]
    public sealed partial class PbmpmWorld : MonoBehaviour
    {
        [Header("For all its life")]
        [Tooltip("Width of a grid cell [m]. Halving it costs eight times the particles.")]
        public float cellSize = 0.1f;

        [Tooltip("Particles that there is room for. About 8 fit into a cell.")]
        public int capacity = 65536;

        [Tooltip("Threads, this one counted; 0: one per core.")]
        public int threads;

        [Tooltip("Whether walls close the box. Without them what falls, falls for ever: set kill bounds.")]
        public bool walls = true;

        [Tooltip("Edges of the box [m].")]
        public Vector3 size = new Vector3(4, 4, 4);

        [Tooltip("Coulomb coefficient of the walls, 0 to 100.")]
        public float wallFriction;

        [Tooltip("Whether particles outside of the box are taken out. For worlds without walls.")]
        public bool killOutside;

        [Header("Steps")]
        [Tooltip("Steps per second.")]
        public float rate = 60;

        [Tooltip("Where steps are taken. FixedUpdate for bodies that matter pushes.")]
        public Pace pace = Pace.Frame;

        [Tooltip("Longest time that a frame simulates [s]. What exceeds it by more than a step is given up, and counted.")]
        public float catchUp = 1 / 30f;

        [Tooltip("Steps run beside the frame; what is seen is a step older.")]
        public bool background;

        [Header("Solver")]
        [Tooltip("low, medium or high of 'pbmpm tune', a JSON file: replaces what it names below, and the rate.")]
        public TextAsset preset;

        [Tooltip("Convergent is for everything; the others are for comparison, or to save time. See docs/choosing.md.")]
        public Solver solver = Solver.Convergent;

        [Tooltip("Per substep, 1 to 1000. More are stiffer.")]
        public int iterations = 5;

        [Tooltip("Parts that a step is cut into, 1 to 256.")]
        public int substeps = 1;

        [Tooltip("Motion below the grid's resolution that liquids keep, 0 to 1; 0.9 is lively.")]
        public float flip;

        [Tooltip("Iterations begin only within this many ms of a step; 0: no limit. Results then depend on the machine's speed.")]
        public float timeBudget;

        [Tooltip("Whether matter at rest falls asleep.")]
        public bool sleeping;

        [Tooltip("[m/s^2]")]
        public Vector3 gravity = new Vector3(0, -9.81f, 0);

        static readonly List<PbmpmWorld> Live = new List<PbmpmWorld>();

        readonly List<PbmpmPart> parts = new List<PbmpmPart>();
        readonly List<PbmpmPart> waiting = new List<PbmpmPart>();
        readonly List<PbmpmPart> entering = new List<PbmpmPart>();
        readonly Dictionary<PbmpmSolid, BakedId> solids = new Dictionary<PbmpmSolid, BakedId>();
        readonly Palette palette = new Palette();

        World simulation;
        PbmpmPreset read;
        Vector3 origin;
        bool changed;

        /// <summary>The first world that is enabled; null without one.</summary>
        public static PbmpmWorld First => Live.Count > 0 ? Live[0] : null;

        /// <summary>The world of the C# binding, for all that components do not do. A step in the background is waited for.</summary>
        /// <exception cref="InvalidOperationException">The component is not enabled.</exception>
        public World Simulation
        {
            get
            {
                RequireOpen();
                Finish();
                EnterWaiting();
                return simulation;
            }
        }

        /// <summary>Whether the library's world is there: while the component is enabled.</summary>
        public bool IsOpen => simulation != null;

        /// <summary>The same for parts, which the world calls while no step runs.</summary>
        internal World Core => simulation;

        /// <summary>Colours by the index of a material.</summary>
        internal Palette Colours => palette;

        /// <summary>A place in Unity, as the library counts it.</summary>
        public Vector3 Inward(Vector3 place)
        {
            return place - origin;
        }

        /// <summary>A place that the library tells, in Unity.</summary>
        public Vector3 Outward(Vector3 place)
        {
            return place + origin;
        }

        /// <summary>The identifier of a material, which the world takes in when it is first asked for.</summary>
        public MaterialId IdOf(PbmpmMaterial material)
        {
            if (material == null) throw new ArgumentNullException(nameof(material), "pbmpm: a part of the world '" + name + "' has no material");
            RequireOpen();
            Finish();
            return palette.IdOf(material, simulation);
        }

        internal BakedId Loaded(PbmpmSolid solid)
        {
            if (solid == null) throw new ArgumentNullException(nameof(solid), "pbmpm: a part of the world '" + name + "' has no baked solid");
            BakedId id;
            if (!solids.TryGetValue(solid, out id)) solids.Add(solid, id = simulation.Load(solid.Baked));
            return id;
        }

        /// <summary>Tells the world that a script changed its settings.</summary>
        public void Change()
        {
            changed = true;
        }

        void RequireOpen()
        {
            if (simulation == null) throw new InvalidOperationException("pbmpm: the world '" + name + "' is not enabled");
        }

        // Parts

        internal void Join(PbmpmPart part)
        {
            waiting.Add(part);
        }

        internal void Leave(PbmpmPart part)
        {
            if (waiting.Remove(part) || !parts.Remove(part) || simulation == null) return;
            Finish();
            part.Exit();
        }

        /// <summary>Lets parts in that joined since: obstacles first, since fills leave room for them.</summary>
        void EnterWaiting()
        {
            if (waiting.Count == 0) return;
            entering.AddRange(waiting);
            waiting.Clear();
            for (var turn = Turn.Obstacles; turn <= Turn.Matter; turn++)
                for (var i = 0; i < entering.Count; i++)
                    if (entering[i].Turn == turn && Enters(entering[i]))
                        parts.Add(entering[i]);
            entering.Clear();
        }

        /// <summary>A part that the library refuses is told of once, and switched off; the others go on.</summary>
        static bool Enters(PbmpmPart part)
        {
            try
            {
                part.Enter();
                return true;
            }
            catch (Exception problem)
            {
                Debug.LogException(problem, part);
                part.enabled = false;
                return false;
            }
        }

        // Life

        /// <summary>What is kept between plays of an editor that does not load the scripts anew.</summary>
        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        static void Forget()
        {
            Live.Clear();
        }

        void OnEnable()
        {
            try
            {
                Open();
            }
            catch (Exception problem) when (problem is LibraryException || problem is PbmpmException || problem is FormatException)
            {
                Stop(problem);
            }
        }

        void OnDisable()
        {
            Close();
        }

        void OnValidate()
        {
            changed = true;
        }

        internal void Open()
        {
            if (Library.Log == null) Library.Log = Tell;
            origin = transform.position;
            read = preset == null ? null : PbmpmPreset.Read(preset);
            simulation = new World(Definition());
            try
            {
                ApplySettings();
                ApplyBounds();
            }
            catch
            {
                Close();
                throw;
            }
            clock = new StepClock();
            Live.Add(this);
        }

        /// <summary>Waits for a step in the background. Parts wait for the next time that the world opens.</summary>
        internal void Close()
        {
            Live.Remove(this);
            if (simulation == null) return;
            EndLease();
            simulation.Dispose();
            simulation = null;
            running = false;
            solids.Clear();
            palette.Clear();
            for (var i = 0; i < parts.Count; i++) parts[i].Forget();
            waiting.AddRange(parts);
            parts.Clear();
        }

        /// <summary>A line of the library's log. Of refused calls exceptions tell.</summary>
        static void Tell(LogLevel level, string line)
        {
            if (level == LogLevel.Warning) Debug.LogWarning("pbmpm: " + line);
        }

        /// <summary>Tells what went wrong once, instead of in each frame.</summary>
        void Stop(Exception problem)
        {
            Debug.LogException(problem, this);
            enabled = false;
        }

        WorldDef Definition()
        {
            var definition = WorldDef.Default;
            definition.CellSize = cellSize;
            definition.ParticleCapacity = (uint)Math.Max(0, capacity);
            definition.ThreadCount = threads;
            definition.Origin = Places.Exact(origin);
            definition.DomainEnabled = walls ? 1 : 0;
            definition.DomainMin = size * -0.5f;
            definition.DomainMax = size * 0.5f;
            definition.DomainFriction = wallFriction;
            return definition;
        }

        void ApplySettings()
        {
            var settings = simulation.Settings;
            settings.Gravity = gravity;
            settings.Solver = solver;
            settings.Iterations = iterations;
            settings.Substeps = substeps;
            settings.Flip = flip;
            settings.TimeBudgetMs = timeBudget;
            settings.Sleeping = sleeping ? 1 : 0;
            if (read != null) read.Apply(ref settings);
            simulation.Settings = settings;
            changed = false;
        }

        void ApplyBounds()
        {
            var bounds = KillBounds.Default;
            bounds.Enabled = killOutside ? 1 : 0;
            bounds.Low = size * -0.5f;
            bounds.High = size * 0.5f;
            simulation.KillBounds = bounds;
        }

        void OnDrawGizmos()
        {
            Gizmos.color = new Color(1, 1, 1, 0.4f);
            Gizmos.DrawWireCube(IsOpen ? origin : transform.position, size);
        }
    }
}
