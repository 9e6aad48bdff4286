// Generated from the public headers by bindings/generator; a test compares it with them. Do not edit.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>Numbers of the C headers.</summary>
    public static class Constants
    {
        public const int VersionMajor = 0;
        public const int VersionMinor = 2;
        public const int VersionPatch = 0;
        /// <summary>Number of the binary interface (the shared library's SOVERSION). It changes only when an existing
        /// function, constant or field changes its meaning, type or place.</summary>
        public const int AbiVersion = 1;
        /// <summary>per world</summary>
        public const int MaxMaterials = 256;
        /// <summary>baked solids per world</summary>
        public const int MaxBaked = 256;
        /// <summary>values of one</summary>
        public const int MaxBakedNodes = 134217728;
        /// <summary>of a mesh to bake</summary>
        public const int MaxMeshVertices = 4194304;
        /// <summary>of points to wrap in a hull</summary>
        public const int MaxHullVertices = 262144;
        /// <summary>triangles or edges of a mesh to bake</summary>
        public const int MaxMeshElements = 4194304;
        /// <summary>samples of a body of heights</summary>
        public const int MaxHeights = 1048576;
        /// <summary>at the same time, per process</summary>
        public const int MaxWorlds = 1024;
        /// <summary>per world</summary>
        public const int MaxParticles = 268435456;
        /// <summary>per step</summary>
        public const int MaxSubsteps = 256;
        /// <summary>per substep</summary>
        public const int MaxIterations = 1000;
        /// <summary>Largest displacement of a particle in one substep [cells].</summary>
        public const int MaxCellsPerSubstep = 64;
        /// <summary>Cells per axis and direction around the origin that a particle can be in; beyond, it is deleted with an event.</summary>
        public const int MaxCell = 4194304;
        /// <summary>per world</summary>
        public const int MaxColliders = 1024;
        /// <summary>per world</summary>
        public const int MaxDrains = 256;
        /// <summary>per world</summary>
        public const int MaxEmitters = 256;
        /// <summary>per world</summary>
        public const int MaxForces = 64;
        /// <summary>of the format that this library writes</summary>
        public const int SnapshotVersion = 4;
        /// <summary>the first of the formats that it reads</summary>
        public const int SnapshotOldest = 4;
        /// <summary>that a world keeps until its next step</summary>
        public const int MaxEvents = 1024;
    }

    /// <summary>What a call came to. Zero is success; everything else left the world as it was before the call, except
    /// where the function says otherwise. Details: pbmpm_last_error().</summary>
    public enum Result : int
    {
        Ok = 0,
        /// <summary>null pointer, NaN, infinity, or a value outside its documented range</summary>
        ErrorInvalidArgument = 1,
        /// <summary>null, stale, foreign or made-up identifier</summary>
        ErrorInvalidId = 2,
        /// <summary>the allocator returned null, or the memory budget is used up</summary>
        ErrorOutOfMemory = 3,
        /// <summary>more particles, materials, colliders or worlds than there is room for</summary>
        ErrorCapacity = 4,
        /// <summary>another thread is inside a call on the same world, and one of the two changes it; or a step of it runs in the background</summary>
        ErrorBusy = 5,
        /// <summary>the CPU has no SSE4.2</summary>
        ErrorUnsupportedCpu = 6,
        /// <summary>a structure size, material or feature that this build does not know</summary>
        ErrorUnsupported = 7,
        /// <summary>a worker thread could not be started</summary>
        ErrorThread = 8,
        /// <summary>the object still has users (a material that particles refer to)</summary>
        ErrorInUse = 9,
        /// <summary>the world belongs to the parent process; in the child only destroy works</summary>
        ErrorForked = 10,
        /// <summary>stored data is truncated or changed, or was never the library's</summary>
        ErrorDamaged = 11,
        /// <summary>stored data belongs to a world that was made in another way, or to another version</summary>
        ErrorForeign = 12,
    }

    /// <summary>How grave a line of the log is.</summary>
    public enum LogLevel : int
    {
        /// <summary>a call was refused or failed</summary>
        Error = 1,
        /// <summary>a step went on, but not as asked: particles were deleted</summary>
        Warning = 2,
        /// <summary>a world was created: its grid, kernels and threads</summary>
        Info = 3,
    }

    /// <summary>Instruction sets of the kernels. On x86, PBMPM_ISA=sse4|avx2|avx512 in the environment lowers the choice, and never raises it. It is
    /// read at the first call that needs it. ARM and WebAssembly have one set each.</summary>
    public enum Isa : int
    {
        /// <summary>the CPU is not supported</summary>
        None = 0,
        Sse4 = 1,
        Avx2 = 2,
        Avx512 = 3,
        Neon = 4,
        /// <summary>WebAssembly's SIMD128</summary>
        Wasm = 5,
    }

    /// <summary>What a material resists.</summary>
    public enum MaterialKind : int
    {
        /// <summary>keeps its volume: J = 1</summary>
        Liquid = 0,
        /// <summary>keeps its shape and volume: F is a rotation</summary>
        Elastic = 1,
        /// <summary>an elastic body that shears as far as friction lets it and bears no tension</summary>
        Sand = 2,
        /// <summary>an elastic body that flows where it is strained too far, at constant volume: clay, dough, mud</summary>
        Visco = 3,
    }

    /// <summary>What happens to an elastic particle that is strained beyond all measure.</summary>
    public enum StrainPolicy : int
    {
        /// <summary>singular values of F are kept in [strain_min, strain_max]</summary>
        Clamp = 0,
        /// <summary>deleted, with an event: when F has a condition number above condition_max (the paper's
        /// rule), is a reflection, or stretches by 10,000</summary>
        Delete = 1,
    }

    /// <summary>How the stress of an elastic body follows from F. Here mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)).
    /// Not used by the paper's solver; the dual solver takes every body as fixed corotated.</summary>
    public enum ElasticModel : int
    {
        /// <summary>energy mu |F - R|^2 + lambda/2 (J - 1)^2, R the rotation of F</summary>
        FixedCorotated = 0,
        /// <summary>energy mu/2 (|F|^2 - d) - mu ln J + lambda/2 (ln J)^2; below J = 0.1 ln J is continued by its
        /// second-order expansion, so that inverted matter has a finite stress</summary>
        NeoHookean = 1,
    }

    /// <summary>Which of the fields of a pbmpm_shape count.</summary>
    public enum ShapeKind : int
    {
        /// <summary>half space behind the plane (2D: behind the line) through `position` with the outward `normal`</summary>
        Plane = 0,
        /// <summary>box with `half_extents` (2D: rectangle)</summary>
        Box = 1,
        /// <summary>ball with `radius` (2D: disc)</summary>
        Sphere = 2,
        /// <summary>all points within `radius` of the segment of half length half_extents[0] along the local first axis</summary>
        Capsule = 3,
        /// <summary>solid of any form, see solid.h; for colliders, and for filling, querying and removing</summary>
        Baked = 4,
    }

    /// <summary>How the equations of a substep are solved.</summary>
    public enum Solver : int
    {
        /// <summary>the paper's: the projections of all particles, transferred N times; its stiffness follows from N and dt</summary>
        Paper = 0,
        /// <summary>backward Euler with the materials' own moduli; unknown: one stress per particle. For liquids, sand, and bodies in
        /// liquids. Accelerated proximal gradients (FISTA) with restart</summary>
        Dual = 1,
        /// <summary>the same equations; unknown: the displacements of the nodes. For elastic bodies. L-BFGS with a multilevel
        /// preconditioner; no body gains energy. Leave the bulk modulus of its liquids at 0: stiff ones hardly move</summary>
        Primal = 2,
        /// <summary>explicit MLS-MPM, to compare with: one pass, stable only while sound travels less than a cell per
        /// substep. Liquids need a bulk modulus.</summary>
        Explicit = 3,
        /// <summary>default: the dual, the primal or both for each island of touching matter, see docs/method.md</summary>
        Convergent = 4,
    }

    /// <summary>Where the dual solver keeps the pressure of a liquid.</summary>
    public enum Pressure : int
    {
        /// <summary>calm: each particle keeps its volume; the better it is solved, the more it damps fine motion</summary>
        Particles = 0,
        /// <summary>lively: each cell keeps the volume of its particles; costs more, and pools stay restless. Where
        /// PBMPM_SOLVER_CONVERGENT solves solids with liquid, particles keep it.</summary>
        Cells = 1,
    }

    /// <summary>How a substep follows from those before it.</summary>
    public enum Integrator : int
    {
        /// <summary>backward Euler: first order in dt, damps rotation and oscillation</summary>
        Euler = 0,
        /// <summary>second order: hardly damps them. Acts in islands that the primal solves alone; elsewhere EULER does</summary>
        Bdf2 = 1,
    }

    /// <summary>What ended the iterations of a substep.</summary>
    public enum Stop : int
    {
        /// <summary>all iterations were done</summary>
        Iterations = 0,
        /// <summary>the predicted error fell below target_error</summary>
        Error = 1,
        /// <summary>time_budget_ms was spent</summary>
        Time = 2,
    }

    /// <summary>Fields of particles.</summary>
    public enum Field : int
    {
        /// <summary>d floats [m], relative to the origin</summary>
        Position = 0,
        /// <summary>d floats [m/s]</summary>
        Velocity = 1,
        /// <summary>d*d floats [1/s], row-major: velocity gradient of the particle's neighbourhood</summary>
        AffineVelocity = 2,
        /// <summary>1 float: J of a liquid particle, in [0.05, 1.2]; det F of an elastic one as of its last step. Sand with the dual or
        /// the convergent solver: J, stored beside F</summary>
        VolumeRatio = 3,
        /// <summary>d*d floats, row-major F; identity for liquids; only once the world had a particle that is not liquid. Sand with the
        /// dual or the convergent solver: its shape tells the deviator of the stress, det F the pressure p, as exp(-p / K)</summary>
        Deformation = 4,
        /// <summary>1 uint32: index of the material's identifier</summary>
        Material = 5,
        /// <summary>2 uint32: pbmpm_particle_id</summary>
        Particle = 6,
        /// <summary>1 float [kg] (2D: per metre of depth); read-only</summary>
        Mass = 7,
        /// <summary>1 float [Pa] (2D: N/m): of a liquid particle, or of sand with the dual or the convergent solver, as last solved for; 0 for elastic
        /// ones. Of a compressed liquid it is the pressure K (1 - J) times J. Take the mean
        /// over a few cells: differences between neighbouring particles cause no motion.</summary>
        Pressure = 8,
        /// <summary>1 uint32: the host's own, which goes with the particle (a colour, an owner); 0 unless it was given. Only once one
        /// that is not 0 was given, or any was set: before, it takes no memory.</summary>
        UserValue = 9,
    }

    /// <summary>What an obstacle does to motion along its surface.</summary>
    public enum Friction : int
    {
        /// <summary>tangential impulse up to friction_coefficient times the normal impulse. A liquid's pressure does
        /// not rub; what holds it is its kinematic_viscosity: water slips, honey does not.
        /// Not the paper's solver and the primal: there
        /// liquid slips</summary>
        Coulomb = 0,
        /// <summary>matter moves with the surface and cannot leave it; liquid, too</summary>
        Stick = 1,
        /// <summary>no tangential impulse, of viscous liquid neither</summary>
        Slip = 2,
    }

    /// <summary>What became of a touch since the call before.</summary>
    public enum TouchState : int
    {
        /// <summary>it is new</summary>
        Began = 1,
        /// <summary>it was there before</summary>
        Stays = 2,
        /// <summary>it is no more</summary>
        Ended = 3,
    }

    /// <summary>What an advice is about. Cells are counted in cell sizes, and a substep lasts dt / settings.substeps.</summary>
    public enum AdviceCode : int
    {
        /// <summary>settings.gravity is 0, and no uniform force acts</summary>
        NoGravity = 1,
        /// <summary>matter has nothing below it along gravity, and no kill bounds take it. Or kill bounds take a part of it that was put
        /// there, before the first step. Figure: share of the matter</summary>
        FallsForever = 2,
        /// <summary>a parameter that was changed does nothing here; the text names it. Figure: its value; bound: its default</summary>
        Ignored = 3,
        /// <summary>a liquid is compressed by its weight. Figure: g dt^2 depth / dx^2, dt the substep's; with the paper's solver
        /// the strain at the bottom</summary>
        PoolTooDeep = 4,
        /// <summary>a pool does not come to rest. Foreseen with the dual solver: figure the rms speed [m/s] that such pools have, within a factor of three.
        /// Or came true: liquid that nothing drives moves so five seconds after its first step. A wave of half a cell is faster</summary>
        PoolStirs = 5,
        /// <summary>the iterations are too few for the material's modulus. Figure: the Young modulus [Pa] that acts; bound: its own</summary>
        ModulusNotHeld = 6,
        /// <summary>sand is crushed, comes to rest too flat, or runs too fast or too slowly; the text tells which. Crushed by its weight: figure g dt^2 depth / dx^2, dt the substep's,
        /// with the dual solver and beside liquid; else its mean strain. Crushed where it lands, too flat, or running through a hole: its
        /// speed there [cells per substep]</summary>
        SandNotHeld = 7,
        /// <summary>a body is too thin for the grid. Figure: its thickness [cells]</summary>
        BodyTooThin = 8,
        /// <summary>the time step damps what bounces: bodies of the dual solver, balls of the primal that fall on obstacles, and bodies that hit each other. Figure: substeps that
        /// the contact of an equally thick ball lasts (Hertz's theory)</summary>
        BounceDamped = 9,
        /// <summary>a round body rolls too slowly. Figure: half the width of its contact by Hertz's theory [cells]</summary>
        RollingBraked = 10,
        /// <summary>an obstacle moves so fast that it skips past matter. Figure: its displacement in the next substep [cells]</summary>
        ColliderTooFast = 11,
        /// <summary>an obstacle between matter on both sides is so thin that one side feels the other. Figure: its thickness [cells]</summary>
        ColliderTooThin = 12,
        /// <summary>matter or a jet is faster than settings.max_displacement lets it be. Or liquid and bodies enter each other where they
        /// meet. Figure: [cells per substep]</summary>
        StepTooLong = 13,
        /// <summary>before the first step: matter was put where there is other matter. Figure: share of the material that lies in
        /// overfull places; for liquids, of all liquids together</summary>
        Overlaps = 17,
        /// <summary>what the library does not do right; the text says what, and what helps if anything does. No figure</summary>
        KnownLimit = 18,
        /// <summary>sand above a floor of the domain that has no friction, with no obstacle between. Figure: its Coulomb coefficient. Or a liquid
        /// with kinematic_viscosity among walls none of which holds it, or a rigid body on such a floor. Figure: 0</summary>
        NoFriction = 19,
        /// <summary>an emitter stands wholly beyond a wall of the domain, so it emits nothing. Figure: how far beyond [cells]</summary>
        EmitterOutside = 20,
        /// <summary>came true: an emitter found its place full, so it gave less than its rate. Figure: the share that was refused so far</summary>
        EmitterRefused = 21,
        /// <summary>a baked obstacle has too coarse a grid at an edge that liquid or sand comes to. Edges are those of the box around it. Figure:
        /// the width of its grid's cells [cells of the world]</summary>
        ColliderTooCoarse = 22,
        /// <summary>matter takes less room than its rest volume. Figure: the share that is lost at least, the measured loss less two standard errors</summary>
        VolumeLost = 14,
        /// <summary>a solid is strained to a bound of its material. Figure: share of its particles</summary>
        StrainClamped = 15,
        /// <summary>the last substep's solution is far from done. Figure: its predicted error [cells], at most what matter moved by, root mean square</summary>
        NotSolved = 16,
    }

    /// <summary>What would help.</summary>
    public enum Change : int
    {
        /// <summary>no setting would help, or only one that makes a step more than eight times as dear; see the text</summary>
        None = 0,
        /// <summary>settings.substeps, or the rate in the same proportion</summary>
        Substeps = 1,
        /// <summary>settings.iterations</summary>
        Iterations = 2,
        /// <summary>world_def.cell_size [m]</summary>
        CellSize = 3,
        /// <summary>settings.solver; the value is a pbmpm_solver</summary>
        Solver = 4,
        /// <summary>settings.gravity; the value is a strength [m/s^2]</summary>
        Gravity = 5,
        /// <summary>pbmpm_world_set_kill_bounds(), or something to fall on</summary>
        KillBounds = 6,
        /// <summary>the parameter; the value is its default</summary>
        Parameter = 7,
        /// <summary>material_def.young_modulus [Pa]: a softer body that looks the same at any rate</summary>
        YoungModulus = 8,
        /// <summary>settings.integrator; the value is a pbmpm_integrator</summary>
        Integrator = 9,
        /// <summary>the obstacle's thickness [m]</summary>
        Collider = 10,
        /// <summary>the obstacle's grid, baked with more resolution; the value is its baked_info.spacing [m]</summary>
        BakedSpacing = 11,
    }

    /// <summary>What lines can show; sums of these choose.</summary>
    public enum DebugPart : int
    {
        /// <summary>the walls that are closed; no end is drawn where one is open</summary>
        Domain = 1,
        /// <summary>where they stand now</summary>
        Colliders = 2,
        /// <summary>where they stand now, those that are switched off too</summary>
        Emitters = 4,
        /// <summary>the same</summary>
        Drains = 8,
        /// <summary>those that are switched on</summary>
        Forces = 16,
        /// <summary>if they are enabled</summary>
        KillBounds = 32,
        /// <summary>blocks of the grid that held particles in the last substep</summary>
        Blocks = 64,
        /// <summary>blocks that sleep</summary>
        Asleep = 128,
        /// <summary>everything</summary>
        All = 255,
    }

    /// <summary>Where an emitter's particles are born.</summary>
    public enum EmitterRegion : int
    {
        /// <summary>anywhere inside the shape</summary>
        Volume = 0,
        /// <summary>on the disc of the shape's `radius` around its `position` that is perpendicular to `direction` (2D: on
        /// that line); the kind of the shape does not matter</summary>
        Disc = 1,
    }

    /// <summary>What a force does. c: the shape's position; r = x - c; s: the share that is felt at x, see pbmpm_falloff; dx: the cell size. Nearer
    /// than dx to the centre or the axis, RADIAL and VORTEX fall to 0.</summary>
    public enum ForceKind : int
    {
        /// <summary>acceleration strength * s along `direction`</summary>
        Uniform = 0,
        /// <summary>acceleration strength * s * r / max(|r|, dx): pushes away, or pulls when negative</summary>
        Radial = 1,
        /// <summary>acceleration strength * s * (n cross r) / max(|n cross r|, dx) about the axis n = `direction` through c; 2D:
        /// n points along the third axis: counter-clockwise</summary>
        Vortex = 2,
        /// <summary>acceleration -k (v - w) with k = strength * s and w = velocity + spin * (n cross r): wind, a whirl, or,
        /// with w = 0, a brake. Negative strengths are refused.</summary>
        Drag = 3,
        /// <summary>matter takes on w, as above: DRAG with k = -60 ln(1 - s) per second, infinite where s = 1: there its
        /// velocity is w, whatever hangs from it, but within a cell of obstacles these come first. No pull is
        /// too strong for it: where that matters use DRAG</summary>
        Grab = 4,
    }

    /// <summary>The share s of a force at the distance d outside of its shape; inside of it s = 1.</summary>
    public enum Falloff : int
    {
        /// <summary>1 up to d = range, then 0</summary>
        None = 0,
        /// <summary>1 - d / range, not below 0</summary>
        Linear = 1,
        /// <summary>(1 - (d / range)^2)^2 up to d = range, then 0</summary>
        Smooth = 2,
        /// <summary>(1 + d / range)^-2 at any distance: gravity of a ball of the radius `range`</summary>
        InverseSquare = 3,
    }

    /// <summary>How far a body may move, or turn.</summary>
    public enum Freedom : int
    {
        /// <summary>in every direction</summary>
        All = 0,
        /// <summary>along, or about, the axis alone</summary>
        Axis = 1,
        /// <summary>in every direction but along, or about, the axis</summary>
        Plane = 2,
        /// <summary>not at all</summary>
        None = 3,
    }

    /// <summary>What a restore does beside the usual.</summary>
    public enum RestoreFlags : int
    {
        /// <summary>for saves of before a patch: the world keeps its own parameters, see pbmpm_snapshot_restore()</summary>
        RestoreKeepParameters = 1,
    }

    /// <summary>What an event tells.</summary>
    public enum EventKind : int
    {
        /// <summary>a particle's state was NaN or infinite; it was taken out before it touched others</summary>
        DeletedNotFinite = 1,
        /// <summary>beyond PBMPM_MAX_CELL</summary>
        DeletedOutOfRange = 2,
        /// <summary>strain beyond condition_max</summary>
        DeletedCondition = 3,
        /// <summary>slowed to max_displacement</summary>
        SpeedClamped = 4,
        /// <summary>a call asked for more particles than there is room for; count: how many</summary>
        Capacity = 5,
        /// <summary>an emitter had no space, no budget or no room for particles that were due; count: how many; at
        /// the emitter's position</summary>
        EmissionRefused = 6,
        /// <summary>left the kill bounds; count: how many; the first of them</summary>
        Killed = 7,
    }

    /// <summary>2 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Uint2
    {
        public uint X;
        public uint Y;

        public Uint2(uint x, uint y)
        {
            X = x;
            Y = y;
        }
    }

    /// <summary>2 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Float2
    {
        public float X;
        public float Y;

        public Float2(float x, float y)
        {
            X = x;
            Y = y;
        }
    }

    /// <summary>3 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Uint3
    {
        public uint X;
        public uint Y;
        public uint Z;

        public Uint3(uint x, uint y, uint z)
        {
            X = x;
            Y = y;
            Z = z;
        }
    }

    /// <summary>3 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Float3
    {
        public float X;
        public float Y;
        public float Z;

        public Float3(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }
    }

    /// <summary>4 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Float4
    {
        public float X;
        public float Y;
        public float Z;
        public float W;

        public Float4(float x, float y, float z, float w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }
    }

    /// <summary>3 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Double3
    {
        public double X;
        public double Y;
        public double Z;

        public Double3(double x, double y, double z)
        {
            X = x;
            Y = y;
            Z = z;
        }
    }

    /// <summary>4 numbers, in C an array.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Double4
    {
        public double X;
        public double Y;
        public double Z;
        public double W;

        public Double4(double x, double y, double z, double w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }
    }

    /// <summary>Identifiers are values of 8 bytes. All zero means "none". A generation is never used twice in a process (short
    /// of 2^32 objects). So a stale identifier, or one of another world, is refused.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct WorldId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A material of one world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct MaterialId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A collider of one world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ColliderId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A particle of one world; it keeps it for life.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ParticleId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>Parameters of one material. Fill it with pbmpm_material_def_init(), then change what differs. What solvers do with them: docs/method.md, "Matter".
    ///
    /// Sand and visco are elastic bodies with one more law. What is said of elastic ones holds for them, except elastic_model. Their elasticity_ratio is
    /// at least 0.01.
    ///
    /// With the paper's solver stiffness is no parameter: it follows from the rate. A liquid acts with the bulk modulus
    /// density * relaxation * N * dx^2 / (4 d dt^2). An elastic body acts with the Young modulus density * relaxation * N * dx^2 / (4 dt^2).
    /// The other solvers take bulk_modulus, elastic_model, young_modulus and poisson_ratio. All solvers take kinematic_viscosity.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct MaterialDef
    {
        /// <summary>sizeof(pbmpm_material_def), set by pbmpm_material_def_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_LIQUID; cannot be changed later</summary>
        public MaterialKind Kind;
        /// <summary>rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6]; default 1000</summary>
        public float Density;
        /// <summary>share of the constraint error removed per iteration, in (0, 2); default 1.5. With one
        /// iteration lone elastic particles tremble above 4/3.</summary>
        public float Relaxation;
        /// <summary>liquid: share, with the paper's solver alone, of the deviatoric strain rate removed per iteration, in [0, 1]; default 0.
        /// Acts as a kinematic viscosity of N * viscosity * dx^2 / (8 dt).</summary>
        public float Viscosity;
        /// <summary>liquid, visco, and sand with the dual solver: share by which J follows the volume that the grid holds, in [0, 1];
        /// default 0.1. Per substep with the paper's solver, else per 1/60 s, or per substep if that is longer. 0 switches it off,
        /// which costs nothing. What it does, and where: docs/method.md, "Liquids keep their volume". Visco that came apart closes up
        /// again before it bears pressure, unless this is 0</summary>
        public float VolumeFeedback;
        /// <summary>elastic, the paper's solver: beta in [0, 1]; default 1. 1 resists any change of shape, 0 that of volume alone; between it
        /// is beta * rotation + (1 - beta) * the shape at unit volume</summary>
        public float ElasticityRatio;
        /// <summary>elastic; default PBMPM_STRAIN_CLAMP</summary>
        public StrainPolicy StrainPolicy;
        /// <summary>elastic: lower bound of the singular values of F, in [1e-3, 1]; default 0.1</summary>
        public float StrainMin;
        /// <summary>elastic: upper bound, in [1, 1e4]; default 20</summary>
        public float StrainMax;
        /// <summary>elastic, PBMPM_STRAIN_DELETE: largest condition number of F, in [10, 1e6]; default 1e6</summary>
        public float ConditionMax;
        /// <summary>elastic: largest strain that the constraint asks for per iteration, in (0, 10]; default 1.
        /// Matter that was crushed to nothing grows back at this rate instead of exploding.</summary>
        public float ReboundMax;
        /// <summary>liquid, not the paper's solver: K [Pa] (2D: N/m) of the pressure K (1 - J), in [1e-3, 1e15], or 0
        /// (default): incompressible</summary>
        public float BulkModulus;
        /// <summary>liquid: nu [m^2/s], in [0, 1e6]; default 0. Honey has about 0.005. It does not slip on obstacles and walls, but for
        /// rigid bodies (rigid.h) and those with PBMPM_FRICTION_SLIP; with the primal as with the paper's
        /// solver it does. The paper's solver adds a share of 8 nu dt / (N dx^2) to
        /// `viscosity`. Together they are at most 1: nu up to N dx^2 / (8 dt)</summary>
        public float KinematicViscosity;
        /// <summary>elastic, not the paper's solver; default PBMPM_FIXED_COROTATED</summary>
        public ElasticModel ElasticModel;
        /// <summary>elastic, not the paper's solver: E [Pa] (2D: plane strain), in [1e-3, 1e15]; default 1e5</summary>
        public float YoungModulus;
        /// <summary>elastic, not the paper's solver: nu, in [0, 0.495]; default 0.3</summary>
        public float PoissonRatio;
        /// <summary>sand: phi [rad], in [0, 1.4]; default pi/6; tan(phi) is the friction coefficient. Mohr and Coulomb's law in 2D and
        /// 3D: a shear stress is at most sin(phi) times the mean of the largest and the smallest pressure.</summary>
        public float FrictionAngle;
        /// <summary>sand: ln of the volume ratio J up to which it bears tension, in [0, 0.5]; default 0: dry</summary>
        public float Cohesion;
        /// <summary>sand: 1 (default): sand that came apart closes up again before it bears pressure, from up to three times its volume (dual solver: 1.15
        /// times); 0: it does not, and a heap grows with each fall</summary>
        public uint VolumeCorrection;
        /// <summary>visco: largest norm of the deviator of the logarithmic strain (ln of the stretches) that it bears, in
        /// [0, 10]; default 0.05. The yield stress in shear is sqrt(2) mu yield_strain.</summary>
        public float YieldStrain;
        /// <summary>visco [1/s]: strain beyond that shrinks by exp(-flow_rate dt), in [0, 1e9]; default 100. Flows like a
        /// Bingham fluid with the viscosity mu / flow_rate [Pa s], if flow_rate dt is far below 1. The default at 60 Hz has 1.7.
        /// Then the rate decides, too.</summary>
        public float FlowRate;
        /// <summary>how snapshots find it again; no two materials of a world may share one. 0 (default): none; the index of its identifier counts,
        /// see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>bit by bit, the groups that it belongs to, not 0; default 1. See pbmpm_collider_def.meets. Walls of the domain act on all.</summary>
        public uint Groups;
        /// <summary>0</summary>
        public uint Reserved;

        /// <summary>The library's defaults.</summary>
        public static MaterialDef Default
        {
            get
            {
                Library.Check();
                MaterialDef it;
                Library.Require(Methods.pbmpm_material_def_init(&it, (UIntPtr)sizeof(MaterialDef)));
                return it;
            }
        }
    }

    /// <summary>How stiff a material is with a world's settings and rate.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Effective
    {
        /// <summary>sizeof(pbmpm_effective), set by the caller</summary>
        public uint Size;
        /// <summary>[Pa]; 0: incompressible. Paper's solver, liquid: density * relaxation * N * dx^2 / (4 d dt^2); elastic: a third (2D: half)
        /// of young_modulus. Other solvers: the material's own. The primal solves an incompressible liquid as a
        /// compressible one: then the modulus that it used in the last step.</summary>
        public float BulkModulus;
        /// <summary>elastic [Pa]; 0 for a liquid. Paper's solver: density * relaxation * N * dx^2 / (4 dt^2). Dual: the material's own or
        /// what N iterations reach, whichever is less. Primal and explicit: the material's own. Convergent: as the
        /// solver of the island that the particles are in now; of several islands the softest.</summary>
        public float YoungModulus;
        /// <summary>liquid [m^2/s]: the material's own; paper's solver: with N viscosity dx^2 / (8 dt) added, and at most
        /// N dx^2 / (8 dt); without what the transfers add</summary>
        public float KinematicViscosity;
        /// <summary>cells that its pressure wave travels per substep; 0: incompressible. Explicit: must stay below 1.</summary>
        public float Courant;
    }

    /// <summary>What is known of a baked solid.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct BakedInfo
    {
        /// <summary>sizeof(pbmpm_baked_info), set by the caller</summary>
        public uint Size;
        /// <summary>2 or 3</summary>
        public int Dimension;
        /// <summary>values per axis</summary>
        public Uint3 Count;
        /// <summary>[m] width of a grid cell. Distances err by less than half of it. Where several parts of the surface are equally near
        /// they err by up to 0.87 of it (2D: 0.71).</summary>
        public float Spacing;
        /// <summary>lower corner of the grid [m], relative to the solid's own frame: that of the mesh</summary>
        public Float3 Minimum;
        /// <summary>upper corner; the surface lies two cells inside</summary>
        public Float3 Maximum;
        /// <summary>that it takes, stored or loaded</summary>
        public ulong Bytes;
    }

    /// <summary>A baked solid that a world has loaded.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct BakedId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A solid shape with its pose. Lengths in metres, positions relative to the world's origin.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Shape
    {
        /// <summary>sizeof(pbmpm_shape), set by pbmpm_shape_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_BOX</summary>
        public ShapeKind Kind;
        /// <summary>centre, or a point of the plane; default 0</summary>
        public Float3 Position;
        /// <summary>unit quaternion (x, y, z, w); normalised by the library, length in [0.5, 2]; default (0, 0, 0, 1).
        /// 2D: a turn by the angle a is (0, 0, sin(a/2), cos(a/2)); x and y must be 0.</summary>
        public Float4 Rotation;
        /// <summary>box: &gt; 0 per axis; capsule: [0] &gt;= 0; default 0.5</summary>
        public Float3 HalfExtents;
        /// <summary>sphere, capsule: &gt; 0; default 0.5</summary>
        public float Radius;
        /// <summary>plane: outward direction before rotation, any length &gt; 1e-6; default (0, 1, 0)</summary>
        public Float3 Normal;
        /// <summary>baked: the solid, of the same world; `position` is where the origin of its mesh stands; default null</summary>
        public BakedId Baked;

        /// <summary>The library's defaults.</summary>
        public static Shape Default
        {
            get
            {
                Library.Check();
                Shape it;
                Library.Require(Methods.pbmpm_shape_init(&it, (UIntPtr)sizeof(Shape)));
                return it;
            }
        }
    }

    /// <summary>What a world is made of for all its life. Fill it with pbmpm_world_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct WorldDef
    {
        /// <summary>sizeof(pbmpm_world_def), set by pbmpm_world_def_init()</summary>
        public uint Size;
        /// <summary>2 or 3; default 3. In 2D the third component of every vector is ignored.</summary>
        public int Dimension;
        /// <summary>grid spacing dx [m], in [1e-6, 1e6]; default 0.1</summary>
        public float CellSize;
        /// <summary>hard limit, 1 to PBMPM_MAX_PARTICLES; default 65536. Memory is taken at creation: some 230 bytes per particle in 3D,
        /// and 0.12 MB for the tables of 256 materials and 1024 events. Fields that a solver needs, colliders and
        /// blocks take theirs when they come.</summary>
        public uint ParticleCapacity;
        /// <summary>what positions are relative to [m]; default 0. The library does not compute with it, so a scene far from
        /// zero loses no precision; the host adds it. pbmpm_world_shift_origin() moves it.</summary>
        public Double3 Origin;
        /// <summary>bytes that the world may hold at once; 0 (default): no limit</summary>
        public ulong MemoryBudget;
        /// <summary>1 to 256, counting the caller; 0 (default): one per core. Results do not depend on it.
        /// With task hooks: how many shares the work is cut into.</summary>
        public int ThreadCount;
        /// <summary>0 (default): unbounded: what falls, falls for ever and costs time; set kill bounds (drain.h) to take it out.
        /// 1: closed box, walls that hold matter in; pbmpm_domain_wall_set() opens one.</summary>
        public int DomainEnabled;
        /// <summary>lower corner of the box [m], relative to the origin; default 0</summary>
        public Float3 DomainMin;
        /// <summary>upper corner; at least 4 cells above domain_min per axis; default 1</summary>
        public Float3 DomainMax;
        /// <summary>Coulomb coefficient of the walls, in [0, 100]; default 0; see pbmpm_friction</summary>
        public float DomainFriction;
        /// <summary>1: pbmpm_domain_impulse() tells what matter does to the walls; 0 (default): costs nothing</summary>
        public int DomainMeasuresImpulse;
        /// <summary>null (default): the C library's memory. Read at creation only.</summary>
        public IntPtr Allocator;
        /// <summary>null (default): the world's own threads. Read at creation only.</summary>
        public IntPtr Tasks;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;

        /// <summary>The library's defaults.</summary>
        public static WorldDef Default
        {
            get
            {
                Library.Check();
                WorldDef it;
                Library.Require(Methods.pbmpm_world_def_init(&it, (UIntPtr)sizeof(WorldDef)));
                return it;
            }
        }
    }

    /// <summary>What may change between steps. State is kept in physical units, so a change of rate changes no motion.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Settings
    {
        /// <summary>sizeof(pbmpm_settings), set by pbmpm_settings_init()</summary>
        public uint Size;
        /// <summary>equal parts that a step is cut into, 1 to PBMPM_MAX_SUBSTEPS; default 1</summary>
        public int Substeps;
        /// <summary>N: of the solver, per substep, 1 to PBMPM_MAX_ITERATIONS; default 5. Ignored by PBMPM_SOLVER_EXPLICIT.</summary>
        public int Iterations;
        /// <summary>acceleration [m/s^2]; default 0</summary>
        public Float3 Gravity;
        /// <summary>largest particle displacement per substep [cells], in [0.1, PBMPM_MAX_CELLS_PER_SUBSTEP];
        /// default 32. Faster particles are slowed to it; each time is counted in the events.</summary>
        public float MaxDisplacement;
        /// <summary>default PBMPM_SOLVER_CONVERGENT</summary>
        public Solver Solver;
        /// <summary>dual solver; default PBMPM_PRESSURE_PARTICLES</summary>
        public Pressure Pressure;
        /// <summary>default PBMPM_INTEGRATOR_EULER</summary>
        public Integrator Integrator;
        /// <summary>share alpha of the motion below the grid's resolution that liquids without viscosity keep (ASFLIP: Fei, Guo, Wu, Huang, Gao 2021;
        /// not the paper's solver), in [0, 1]; default 0. 0.9 is lively.</summary>
        public float Flip;
        /// <summary>dual and primal: iterations end when the predicted error of the solution [cells] is below this;
        /// in [0, 1], 0 (default): off</summary>
        public float TargetError;
        /// <summary>dual and primal: no iteration is begun once this much wall time [ms] of the step is spent; each
        /// substep gets an equal part; in [0, 1e6], 0 (default): off. Results then depend on the machine's
        /// speed: not deterministic.</summary>
        public float TimeBudgetMs;
        /// <summary>1: blocks of matter at rest fall asleep: they take no part in a step until something wakes them, see sleep.h;
        /// 0 (default): off, costs nothing</summary>
        public int Sleeping;
        /// <summary>sleeping: root mean square speed of a block's particles below which it is at rest [m/s], in
        /// [0, 1e9]; default 0.05</summary>
        public float SleepSpeed;
        /// <summary>sleeping: how long a block and its neighbours must be at rest [s], in [0, 1e6]; default 0.5</summary>
        public float SleepTime;

        /// <summary>The library's defaults.</summary>
        public static Settings Default
        {
            get
            {
                Library.Check();
                Settings it;
                Library.Require(Methods.pbmpm_settings_init(&it, (UIntPtr)sizeof(Settings)));
                return it;
            }
        }
    }

    /// <summary>Particles that fill a shape on a jittered lattice.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct FillDef
    {
        /// <summary>sizeof(pbmpm_fill_def), set by pbmpm_fill_def_init()</summary>
        public uint Size;
        /// <summary>of the jitter; equal seeds give equal particles; default 1</summary>
        public uint Seed;
        public MaterialId Material;
        /// <summary>lattice points per cell and axis, in [0.25, 16]; default 2 (4 per cell in 2D, 8 in 3D)</summary>
        public float ParticlesPerAxis;
        /// <summary>random offset as a share of the lattice spacing, in [0, 1]; default 0.5</summary>
        public float Jitter;
        /// <summary>of every particle [m/s]; default 0</summary>
        public Float3 Velocity;
        /// <summary>of every particle, see PBMPM_USER_VALUE; default 0</summary>
        public uint UserValue;

        /// <summary>The library's defaults.</summary>
        public static FillDef Default
        {
            get
            {
                Library.Check();
                FillDef it;
                Library.Require(Methods.pbmpm_fill_def_init(&it, (UIntPtr)sizeof(FillDef)));
                return it;
            }
        }
    }

    /// <summary>An obstacle. Fill it with pbmpm_collider_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct ColliderDef
    {
        /// <summary>sizeof(pbmpm_collider_def), set by pbmpm_collider_def_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_FRICTION_COULOMB</summary>
        public Friction Friction;
        /// <summary>Coulomb coefficient, in [0, 100]; default 0.2</summary>
        public float FrictionCoefficient;
        /// <summary>0 (default): never moves. 1: pbmpm_collider_move() moves it.</summary>
        public int Kinematic;
        /// <summary>1: pbmpm_collider_impulse() tells what matter does to it; 0 (default): costs nothing</summary>
        public int MeasuresImpulse;
        /// <summary>bits of `groups` of the materials that it acts on; 0 (default): all. Other matter passes as if it were not there.
        /// Fills, emitters, touches and pbmpm_collider_submerged() respect it; queries do not. Matter that passes
        /// is slowed within 2.5 cells of matter that is held, see docs/limits.md.</summary>
        public uint Meets;
        /// <summary>how snapshots find it again; no two colliders of a world may share one. 0 (default): none; the index of its identifier counts,
        /// see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>1: acts on nothing, for triggers; matter passes through it, so it measures no impulse. 0 (default): an obstacle</summary>
        public int Sensor;
        /// <summary>1: pbmpm_world_touches() tells what touches it; 0 (default): costs nothing</summary>
        public int ReportsTouches;

        /// <summary>The library's defaults.</summary>
        public static ColliderDef Default
        {
            get
            {
                Library.Check();
                ColliderDef it;
                Library.Require(Methods.pbmpm_collider_def_init(&it, (UIntPtr)sizeof(ColliderDef)));
                return it;
            }
        }
    }

    /// <summary>What matter gave to an obstacle in a step: the momentum that matter lost to it. A host that moves a rigid body
    /// itself adds it to the body's momentum; pbmpm_rigid_advance() does that, see rigid.h. The sum over all obstacles and walls is what matter lost,
    /// apart from gravity, forces, and deleted or slowed particles. In 2D per metre of depth.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Impulse
    {
        /// <summary>sizeof(pbmpm_impulse), set by the caller</summary>
        public uint Size;
        /// <summary>[N s]</summary>
        public Double3 Linear;
        /// <summary>[N m s] about the obstacle's position after the step; walls: about the world's origin. 2D: only component 2</summary>
        public Double3 Angular;
    }

    /// <summary>A wall of the domain. Read it with pbmpm_domain_wall_get(), change what differs, and give it to pbmpm_domain_wall_set().</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct DomainWall
    {
        /// <summary>sizeof(pbmpm_domain_wall), set by the caller</summary>
        public uint Size;
        /// <summary>0 (default): holds matter in. 1: there is no wall. The other walls are planes without end: a
        /// floor goes on outside. What gets out falls for ever: set kill bounds (drain.h).</summary>
        public int Open;
        /// <summary>default PBMPM_FRICTION_COULOMB</summary>
        public Friction Friction;
        /// <summary>Coulomb coefficient, in [0, 100]; default world_def.domain_friction</summary>
        public float FrictionCoefficient;
    }

    /// <summary>Matter of a material at a collider.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Touch
    {
        /// <summary>sizeof(pbmpm_touch); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>compared with the call before</summary>
        public TouchState State;
        /// <summary>that is touched</summary>
        public ColliderId Collider;
        /// <summary>of what touches it; null when it was destroyed since</summary>
        public MaterialId Material;
        /// <summary>how many touch it now; 0 when it ended</summary>
        public uint Particles;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>what all matter gave to the collider in the last step [N s], see pbmpm_collider_impulse(); 0 unless it measures that</summary>
        public Double3 Impulse;
    }

    /// <summary>A line to draw. This structure never grows.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Line
    {
        /// <summary>[m], relative to the origin; 2D: z is 0</summary>
        public Float3 From;
        /// <summary>[m], as `from`</summary>
        public Float3 To;
        /// <summary>what it shows: one of the parts, to choose a colour by</summary>
        public DebugPart Part;
    }

    /// <summary>A drain of one world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct DrainId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A shape that takes out the particles inside it. Particles are looked at where they are at the end of each substep: one that crosses a
    /// thin drain within a substep is not seen. A particle inside several drains is counted by the one in the lowest slot.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct DrainDef
    {
        /// <summary>sizeof(pbmpm_drain_def), set by pbmpm_drain_def_init()</summary>
        public uint Size;
        /// <summary>1 (default) or 0</summary>
        public int Enabled;
        /// <summary>what it takes; null (default): everything</summary>
        public MaterialId Material;
        /// <summary>how snapshots find it again; no two drains of a world may share one. 0 (default): none; the index of its identifier counts,
        /// see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;

        /// <summary>The library's defaults.</summary>
        public static DrainDef Default
        {
            get
            {
                Library.Check();
                DrainDef it;
                Library.Require(Methods.pbmpm_drain_def_init(&it, (UIntPtr)sizeof(DrainDef)));
                return it;
            }
        }
    }

    /// <summary>What a drain has taken since it was created.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct DrainStatus
    {
        /// <summary>sizeof(pbmpm_drain_status), set by the caller</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>particles</summary>
        public ulong Drained;
        /// <summary>[kg] (2D: per metre of depth)</summary>
        public double DrainedMass;
    }

    /// <summary>The box that particles live in. Those outside at the end of a substep are taken out, with one
    /// PBMPM_EVENT_KILLED per substep. Unlike the domain it has no walls. Without it matter that falls for ever keeps its capacity and costs time.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct KillBounds
    {
        /// <summary>sizeof(pbmpm_kill_bounds), set by pbmpm_kill_bounds_init()</summary>
        public uint Size;
        /// <summary>0 (default): no bounds; 1: bounds</summary>
        public int Enabled;
        /// <summary>lower corner [m], relative to the origin, in [-1e9, 1e9]; default 0</summary>
        public Float3 Low;
        /// <summary>upper corner [m], above the lower one per axis, in [-1e9, 1e9]; default 1</summary>
        public Float3 High;

        /// <summary>The library's defaults.</summary>
        public static KillBounds Default
        {
            get
            {
                Library.Check();
                KillBounds it;
                Library.Require(Methods.pbmpm_kill_bounds_init(&it, (UIntPtr)sizeof(KillBounds)));
                return it;
            }
        }
    }

    /// <summary>What came and went in the life of a world, with that of emitters and drains that are no more. Particles now = those added by calls -
    /// those removed by calls + emitted - drained - killed - pbmpm_stats.deleted_total.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Flow
    {
        /// <summary>sizeof(pbmpm_flow), set by the caller</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>particles</summary>
        public ulong Emitted;
        /// <summary>particles that were due and not emitted, for any reason</summary>
        public ulong Refused;
        /// <summary>particles</summary>
        public ulong Drained;
        /// <summary>particles that left the kill bounds</summary>
        public ulong Killed;
        /// <summary>[kg] (2D: per metre of depth)</summary>
        public double EmittedMass;
        /// <summary>[kg]</summary>
        public double DrainedMass;
        /// <summary>[kg]</summary>
        public double KilledMass;
    }

    /// <summary>An emitter of one world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct EmitterId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A source of particles. Fill it with pbmpm_emitter_def_init(), then change what differs.
    ///
    /// Let V be the rest volume of a particle, (cell_size / particles_per_axis)^d. The i-th particle (from 0) is due at the time
    /// (i + 1/2) V / rate after the emitter began. So after a time T, T rate / V +- 1/2 particles were due, whatever the substeps.
    /// A particle appears at the end of the substep in which it is due. It is then where gravity has taken it since it was due, with the velocity of
    /// that fall: so a stream has no pulses. If an obstacle that acts on it is in the way it appears where it was born.
    /// Places follow a sequence that fills the region evenly.
    ///
    /// A particle that is due is refused when matter at its place already fills the share `fill_limit` of the grid. Solids that are born too dense stay so.
    /// So solids are refused, too, where the matter around is this full, whatever is empty beside it. No particle may fill more than this share of a space
    /// that obstacles enclose. That space is looked for up to about four cells from the emitter. A particle is refused, too, when the budget is spent or the world has no room. Refused particles are not made up for. They are counted in pbmpm_emitter_status, and told by one PBMPM_EVENT_EMISSION_REFUSED per emitter and substep.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct EmitterDef
    {
        /// <summary>sizeof(pbmpm_emitter_def), set by pbmpm_emitter_def_init()</summary>
        public uint Size;
        /// <summary>of places and directions; equal seeds give equal particles; default 1</summary>
        public uint Seed;
        /// <summary>of the particles; it cannot be destroyed while the emitter exists</summary>
        public MaterialId Material;
        /// <summary>default PBMPM_EMIT_VOLUME</summary>
        public EmitterRegion Region;
        /// <summary>1 (default): emits; 0: rests, and no time passes for it</summary>
        public int Enabled;
        /// <summary>volume per second, not particles: rest volume [m^3/s] (2D: area [m^2/s]), in [0, 1e12]; default 0. An emitter whose
        /// cross-section along `direction` is A runs full with A * speed. Gravity and pressure may take more away.</summary>
        public float Rate;
        /// <summary>[m/s], in [0, 1e6]; default 0</summary>
        public float Speed;
        /// <summary>of the speed before the shape's rotation, any length &gt; 1e-6; default (0, -1, 0)</summary>
        public Float3 Direction;
        /// <summary>largest angle between a particle's velocity and `direction` [rad], in [0, pi], evenly spread over
        /// the cone; default 0</summary>
        public float Spread;
        /// <summary>size of the particles: so many per cell and axis, in [0.25, 16]; default 2</summary>
        public float ParticlesPerAxis;
        /// <summary>rest volume per volume of the grid where nothing more is emitted, in [0.1, 100]; default 1: full.
        /// Only what obstacles leave open counts. A source inside a pool needs more: liquid at rest measures 1 +-
        /// 0.1, and at depth up to 1.2 with the paper's solver</summary>
        public float FillLimit;
        /// <summary>particles that it may emit in its life; 0 (default): no limit</summary>
        public ulong Budget;
        /// <summary>how snapshots find it again; no two emitters of a world may share one. 0 (default): none; the index of its identifier counts,
        /// see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>of its particles, see PBMPM_USER_VALUE; default 0</summary>
        public uint UserValue;
        /// <summary>0</summary>
        public uint Reserved;

        /// <summary>The library's defaults.</summary>
        public static EmitterDef Default
        {
            get
            {
                Library.Check();
                EmitterDef it;
                Library.Require(Methods.pbmpm_emitter_def_init(&it, (UIntPtr)sizeof(EmitterDef)));
                return it;
            }
        }
    }

    /// <summary>What an emitter has done since it was created. due = emitted + refused_full + refused_budget + refused_capacity.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct EmitterStatus
    {
        /// <summary>sizeof(pbmpm_emitter_status), set by the caller</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>particles</summary>
        public ulong Emitted;
        /// <summary>[kg] (2D: per metre of depth): emitted times the mass of a particle</summary>
        public double EmittedMass;
        /// <summary>particles that were due where there was no space: matter, an obstacle, or the outside of the domain</summary>
        public ulong RefusedFull;
        /// <summary>... after the budget was spent</summary>
        public ulong RefusedBudget;
        /// <summary>... when the world was full</summary>
        public ulong RefusedCapacity;
    }

    /// <summary>A force of one world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ForceId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>A force. Fill it with pbmpm_force_def_init(), then change what differs.
    ///
    /// Forces act on the nodes of the grid in the predictor of each substep, before materials and obstacles. Nodes that a GRAB holds with s = 1 also keep
    /// their velocity while materials act. Forces act on blocks in range only.
    /// Let v be a node's velocity after the transfer. a is the sum of gravity and all accelerations. k is that of all drags,
    /// and w the mean of their winds, weighted by k. The velocity becomes the exact solution of v' = a - k (v - w) after the substep dt:
    /// v exp(-k dt) + w (1 - exp(-k dt)) + a (1 - exp(-k dt)) / k       (k = 0: v + a dt)
    /// So drag is stable for any k and dt, and falling matter ends at exactly w + a / k. The order of forces does not matter.
    /// The impulse of each force is what it adds to the momentum of the nodes, see pbmpm_force_status.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct ForceDef
    {
        /// <summary>sizeof(pbmpm_force_def), set by pbmpm_force_def_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_FORCE_UNIFORM</summary>
        public ForceKind Kind;
        /// <summary>1 (default) or 0</summary>
        public int Enabled;
        /// <summary>1 (default): s = 1 everywhere; of the shape only the centre counts. Set 0 for a force that ends at its shape: s by shape and falloff.</summary>
        public int Everywhere;
        /// <summary>default PBMPM_FALLOFF_NONE</summary>
        public Falloff Falloff;
        /// <summary>of the falloff [m], in [0, 1e9], &gt; 0 for INVERSE_SQUARE; default 0: nothing outside of the shape</summary>
        public float Range;
        /// <summary>acceleration [m/s^2], in [-1e9, 1e9]; DRAG: coefficient [1/s], in [0, 1e9]; GRAB: not used; default 1</summary>
        public float Strength;
        /// <summary>UNIFORM: of the acceleration; VORTEX, DRAG and GRAB in 3D: the axis. Any length &gt; 1e-6; default (0, 1, 0)</summary>
        public Float3 Direction;
        /// <summary>DRAG and GRAB [m/s], in [-1e9, 1e9]; default 0</summary>
        public Float3 Velocity;
        /// <summary>DRAG and GRAB: turns about the axis through the shape's position [rad/s], in [-1e6, 1e6]; default 0</summary>
        public float Spin;
        /// <summary>how snapshots find it again; no two forces of a world may share one. 0 (default): none; the index of its identifier counts,
        /// see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;

        /// <summary>The library's defaults.</summary>
        public static ForceDef Default
        {
            get
            {
                Library.Check();
                ForceDef it;
                Library.Require(Methods.pbmpm_force_def_init(&it, (UIntPtr)sizeof(ForceDef)));
                return it;
            }
        }
    }

    /// <summary>What a force did in the last step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ForceStatus
    {
        /// <summary>sizeof(pbmpm_force_status), set by the caller</summary>
        public uint Size;
        /// <summary>nodes with matter that felt it in the last substep</summary>
        public uint Nodes;
        /// <summary>sum over nodes and substeps of what it added to their momentum [kg m/s] (2D: per metre of depth), before
        /// materials and obstacles. UNIFORM, RADIAL, VORTEX: m a dt. DRAG, GRAB: -m k times the integral of v - w.
        /// GRAB where s = 1: and what it bears while materials act. Those that hold the same node share that alike, also
        /// if they want different things</summary>
        public Double3 Impulse;
    }

    /// <summary>What one material has in a region.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct RegionShare
    {
        /// <summary>sizeof(pbmpm_region_share); set by the caller in the first element of an array</summary>
        public uint Size;
        public MaterialId Material;
        /// <summary>particles whose centre is inside</summary>
        public ulong Count;
        /// <summary>of these [kg] (2D: per metre of depth)</summary>
        public double Mass;
        /// <summary>present volume, rest volume times VOLUME_RATIO [m^d]</summary>
        public double Volume;
        /// <summary>[m^d]</summary>
        public double RestVolume;
    }

    /// <summary>A ray. Fill it with pbmpm_ray_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Ray
    {
        /// <summary>sizeof(pbmpm_ray), set by pbmpm_ray_init()</summary>
        public uint Size;
        /// <summary>filling that stops the ray, in (0, 100]; default 0.5: the surface</summary>
        public float Level;
        /// <summary>[m]; default 0</summary>
        public Float3 Origin;
        /// <summary>any length above 1e-6; default (0, -1, 0)</summary>
        public Float3 Direction;
        /// <summary>[m], in [0, 1e9]; default 1e9</summary>
        public float MaxDistance;

        /// <summary>The library's defaults.</summary>
        public static Ray Default
        {
            get
            {
                Library.Check();
                Ray it;
                Library.Require(Methods.pbmpm_ray_init(&it, (UIntPtr)sizeof(Ray)));
                return it;
            }
        }
    }

    /// <summary>Where a ray met matter. Without a hit all but `size` is 0.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct RayHit
    {
        /// <summary>sizeof(pbmpm_ray_hit), set by the caller</summary>
        public uint Size;
        /// <summary>1: the ray met matter</summary>
        public int Hit;
        /// <summary>from the origin [m]</summary>
        public float Distance;
        /// <summary>[m]</summary>
        public Float3 Position;
        /// <summary>unit vector out of the matter: against the gradient of the filling; 0 where that is 0</summary>
        public Float3 Normal;
        /// <summary>of `particle`</summary>
        public MaterialId Material;
        /// <summary>nearest to the position of those that count there (W_p &gt; 0); of equals the first in storage order</summary>
        public ParticleId Particle;
    }

    /// <summary>Volume, mass and inertia of a shape of even density. In 2D per metre of depth.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct MassProperties
    {
        /// <summary>sizeof(pbmpm_mass_properties), set by the caller</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>[m^d]</summary>
        public double Volume;
        /// <summary>[kg]</summary>
        public double Mass;
        /// <summary>of mass [m], from the shape's position, in the shape's own frame</summary>
        public Double3 Centre;
        /// <summary>moments xx, yy, zz about the centre [kg m^2], in the shape's own frame; 2D: only zz, else 0</summary>
        public Double3 Inertia;
        /// <summary>elements xy, yz, zx of the same tensor: -(integral of x y dm) and so on</summary>
        public Double3 Products;
    }

    /// <summary>The part of an obstacle that is under matter.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Submersion
    {
        /// <summary>sizeof(pbmpm_submersion), set by the caller</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>of the obstacle's volume that is under, in [0, 1]</summary>
        public double Share;
        /// <summary>that is under [m^d]; 2D: per metre of depth</summary>
        public double Volume;
        /// <summary>of that volume [m], in the world; without any: of the obstacle</summary>
        public Double3 Centre;
        /// <summary>of the matter around, at rest volume [kg/m^3]; 0 without any</summary>
        public double Density;
    }

    /// <summary>What a rigid body is. Fill it with pbmpm_rigid_def_init(), then change what differs; mass, centre, inertia and products are those of a
    /// pbmpm_mass_properties, or the host's own. It may change from call to call. In 2D the third components of places and the first two of turns are not used.
    ///
    /// A hinge: `moves` NONE, `turns` AXIS. A ball joint: `moves` NONE, `turns` ALL (2D: a hinge). A slider: `moves` AXIS, `turns` NONE.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct RigidDef
    {
        /// <summary>sizeof(pbmpm_rigid_def), set by pbmpm_rigid_def_init()</summary>
        public uint Size;
        /// <summary>0 or 1. 1 (default): corners and round parts stop at walls of the domain, see above; of a baked shape its box. Not with `moves` NONE. 0: it passes.</summary>
        public int StaysInside;
        /// <summary>of its centre of mass; NONE: its `pivot` stays in place instead. Default ALL</summary>
        public Freedom Moves;
        /// <summary>2D: NONE, or else about the third axis. Default ALL</summary>
        public Freedom Turns;
        /// <summary>[kg] (2D: per metre of depth), in [1e-12, 1e15]; default 1</summary>
        public double Mass;
        /// <summary>of mass [m], from the shape's position, in the shape's own frame; within 1e9; default 0</summary>
        public Double3 Centre;
        /// <summary>see pbmpm_mass_properties; the tensor must be positive, its elements within 1e30. 2D: zz alone counts. Default 1, 1, 1</summary>
        public Double3 Inertia;
        /// <summary>see pbmpm_mass_properties; default 0</summary>
        public Double3 Products;
        /// <summary>with `moves` NONE: the point that stays, from the shape's position, in the shape's own frame [m]; within 1e9; default 0</summary>
        public Double3 Pivot;
        /// <summary>of `moves`, in the world, any length from 1e-6 to 1e9; default (0, 1, 0)</summary>
        public Double3 MoveAxis;
        /// <summary>of `turns`, in the world, any length from 1e-6 to 1e9; not used in 2D; default (0, 0, 1)</summary>
        public Double3 TurnAxis;
        /// <summary>of the host, beside gravity and matter, at the centre of mass [N]; within 1e30; default 0</summary>
        public Double3 Force;
        /// <summary>of the host, such as a motor's or a brake's [N m]; within 1e30; default 0</summary>
        public Double3 Torque;

        /// <summary>The library's defaults.</summary>
        public static RigidDef Default
        {
            get
            {
                Library.Check();
                RigidDef it;
                Library.Require(Methods.pbmpm_rigid_def_init(&it, (UIntPtr)sizeof(RigidDef)));
                return it;
            }
        }
    }

    /// <summary>How a rigid body is and moves. In 2D third components are not read, nor angular velocities but the third. pbmpm_rigid_begin() fills it; the host may set velocities, and copies it to go back to it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct RigidState
    {
        /// <summary>sizeof(pbmpm_rigid_state), set by the caller before pbmpm_rigid_begin()</summary>
        public uint Size;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>of the shape [m], at the end of the next step; within 1e9. After pbmpm_world_shift_origin() subtract `moved`.</summary>
        public Double3 Position;
        /// <summary>quaternion (x, y, z, w) of length 0.5 to 2; 2D: x and y are 0</summary>
        public Double4 Rotation;
        /// <summary>of the centre of mass [m/s]; within 1e9</summary>
        public Double3 Velocity;
        /// <summary>[rad/s], in the world; within 1e9</summary>
        public Double3 AngularVelocity;
        /// <summary>by which the last call changed `velocity` [m/s]; the virtual mass needs it in the next one</summary>
        public Double3 VelocityChange;
        /// <summary>the same of `angular_velocity` [rad/s]</summary>
        public Double3 AngularVelocityChange;
        /// <summary>as `position`, after a shift too: where the pivot stays, or a point of the line or plane that the centre of mass moves on [m]; `moves` ALL: not used</summary>
        public Double3 Point;
        /// <summary>V of the last call [kg], 0 where it yielded within the step; for information: the library never reads it</summary>
        public double VirtualMass;
    }

    /// <summary>Figures of the last step. Times are of the whole step (all substeps); state is that at its end. Momentum and angular
    /// momentum are relative to the world's origin; in 2D only component 2 of the angular momentum is used.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Stats
    {
        /// <summary>sizeof(pbmpm_stats), set by the caller</summary>
        public uint Size;
        /// <summary>live particles</summary>
        public uint ParticleCount;
        /// <summary>steps since creation</summary>
        public ulong StepCount;
        /// <summary>since creation</summary>
        public double SimulatedSeconds;
        /// <summary>held by the world</summary>
        public ulong MemoryBytes;
        /// <summary>blocks of 4^d cells with particles; a liquid particle that flies free, far from all else, is in none</summary>
        public uint ParticleBlocks;
        /// <summary>blocks of 4^d nodes that they touch</summary>
        public uint NodeBlocks;
        /// <summary>node-obstacle pairs in the last substep</summary>
        public uint Contacts;
        /// <summary>of the step</summary>
        public uint Substeps;
        /// <summary>per substep</summary>
        public uint Iterations;
        /// <summary>shares the work was cut into</summary>
        public uint ThreadCount;
        /// <summary>wall time [ms] of the step</summary>
        public float MsTotal;
        /// <summary>... of which binning and reordering</summary>
        public float MsSort;
        /// <summary>first P2G and predictor</summary>
        public float MsScatter;
        /// <summary>finding nodes near obstacles</summary>
        public float MsContacts;
        /// <summary>N passes of G2P, projection, P2G and grid update</summary>
        public float MsIterate;
        /// <summary>last G2P, integration, guards</summary>
        public float MsIntegrate;
        /// <summary>root mean square of |J - 1| over particles</summary>
        public float VolumeErrorRms;
        /// <summary>largest |J - 1|</summary>
        public float VolumeErrorMax;
        /// <summary>[m/s]</summary>
        public float MaxSpeed;
        /// <summary>largest particle displacement of the last substep [cells] (the Courant number)</summary>
        public float MaxDisplacement;
        /// <summary>[kg]</summary>
        public double Mass;
        /// <summary>[kg m/s]</summary>
        public Double3 Momentum;
        /// <summary>about the origin, with the affine part [kg m^2/s]</summary>
        public Double3 AngularMomentum;
        /// <summary>translation of particles [J]</summary>
        public double KineticEnergy;
        /// <summary>in gravity, relative to the origin [J]</summary>
        public double PotentialEnergy;
        /// <summary>share of particles that left their cell in the last substep</summary>
        public float CellChanges;
        /// <summary>share of SIMD lanes that held a particle; 1 is perfect</summary>
        public float LaneOccupancy;
        /// <summary>particles deleted by the library since creation (never by calls)</summary>
        public ulong DeletedTotal;
        /// <summary>times a particle was slowed to max_displacement since creation</summary>
        public ulong ClampedTotal;
        /// <summary>of the last substep; PBMPM_SOLVER_CONVERGENT: several. Then iterations, residual and error below are
        /// the largest over the islands, and energy_checks_failed is the sum</summary>
        public Solver Solver;
        /// <summary>what ended its iterations</summary>
        public Stop Stop;
        /// <summary>by it; passes that a line search repeats and those that deep sand takes beyond the iterations set count too</summary>
        public uint IterationsUsed;
        /// <summary>its last change per iteration [cells], root mean square; 0 for the paper's and the explicit solver</summary>
        public float Residual;
        /// <summary>root mean square distance of its displacements from the converged ones [cells], as predicted
        /// from the residual; 0 where residual is</summary>
        public float PredictedError;
        /// <summary>primal, alone or with the dual: bodies whose unfinished solution would have gained energy in the last substep;
        /// they began again from their rigid motion</summary>
        public uint EnergyChecksFailed;
        /// <summary>particles that the last substep did not move because they sleep</summary>
        public uint ParticlesAsleep;
        /// <summary>blocks that took no part in it; particle_blocks counts those that did</summary>
        public uint BlocksAsleep;
        /// <summary>of particle_blocks, those that took part without being moved: next to blocks that are awake</summary>
        public uint BlocksDrowsy;
        /// <summary>blocks that woke in the last step, and by calls before it</summary>
        public uint BlocksWoken;
    }

    /// <summary>Something that happened which the caller did not ask for.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Event
    {
        /// <summary>sizeof(pbmpm_event); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>what happened</summary>
        public EventKind Kind;
        /// <summary>how many particles (deletions: always 1)</summary>
        public uint Count;
        /// <summary>the particle, or the first one of several</summary>
        public ParticleId Particle;
        /// <summary>where [m]</summary>
        public Float3 Position;
        /// <summary>in which substep of the step</summary>
        public uint Substep;
        /// <summary>step_count when it happened</summary>
        public ulong Step;
    }

    /// <summary>What a surface is of, and how fine. Fill it with pbmpm_surface_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct SurfaceDef
    {
        /// <summary>sizeof(pbmpm_surface_def), set by pbmpm_surface_def_init()</summary>
        public uint Size;
        /// <summary>points of the lattice per cell and axis: 1 (a quarter of the triangles, some half of the time) or 2 (default)</summary>
        public uint Subdivision;
        /// <summary>of which it is: `material_count` of them, each once</summary>
        public IntPtr Materials;
        /// <summary>0 (default): all materials</summary>
        public uint MaterialCount;
        /// <summary>filling at the surface, in [0.1, 0.9]; default 0.5: where matter ends. A lower one makes it fatter.</summary>
        public float Level;
        /// <summary>1 (default): layers and threads that are a particle thick are part of it, with about their volume. 0: they vanish</summary>
        public int KeepsThin;
        /// <summary>per index: 2, for up to 65535 vertices, or 4 (default)</summary>
        public uint IndexBytes;

        /// <summary>The library's defaults.</summary>
        public static SurfaceDef Default
        {
            get
            {
                Library.Check();
                SurfaceDef it;
                Library.Require(Methods.pbmpm_surface_def_init(&it, (UIntPtr)sizeof(SurfaceDef)));
                return it;
            }
        }
    }

    /// <summary>A particle to draw: 32 bytes, the layout of {vec3, float, vec3, uint} in GLSL's std430. This structure never grows.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Point
    {
        /// <summary>[m], relative to the origin; 2D: z is 0</summary>
        public Float3 Position;
        /// <summary>[m] of a ball (2D: a disc) of the particle's present volume, times def.radius_scale</summary>
        public float Radius;
        /// <summary>[m/s]; 2D: z is 0</summary>
        public Float3 Velocity;
        /// <summary>4 bytes: red, green, blue, opacity, in this order in memory</summary>
        public uint Colour;
    }
}

namespace Pbmpm.Native
{
    /// <summary>Memory for one world, read at its creation. `allocate` returns a block aligned to at least `alignment` (a power of two, at most 64) or
    /// null; `release` gets the size that was asked for. Called from the thread that calls the library, and
    /// from that of a step in the background (async.h); for one world never from two at once. Must not call the library.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Allocator
    {
        /// <summary>sizeof(pbmpm_allocator), set by the caller</summary>
        public uint Size;
        /// <summary>not null</summary>
        public IntPtr Allocate;
        /// <summary>not null</summary>
        public IntPtr Release;
        /// <summary>passed on unchanged</summary>
        public IntPtr User;
    }

    /// <summary>Lets the host's job system run the library's parallel work. `enqueue` shall have task(i, context) called
    /// once for each i in [0, count), on any threads, in any order. It returns a handle. `finish` returns when all
    /// of these calls have returned. Read at the creation of a world.
    ///
    /// Tasks of one handle may wait for each other, for some milliseconds at most. While they wait they yield their core. None waits for a task that
    /// has not begun, so a host may also run them one after another. Only a step in the background, see `nests`, calls enqueue and finish from a task. There
    /// `finish` shall run other tasks while it waits, or leave a worker free that does: else all workers may wait for each other.
    ///
    /// A substep of 5 iterations enqueues some 10 times with the paper's solver. With the dual it is 30, per group of islands. Loops of less than
    /// some 40 microseconds run on the caller.
    ///
    /// One call at a time uses the hooks of a world; other calls that read the world meanwhile work on their own thread alone. There is one exception: the
    /// step in the background goes on enqueuing while another thread is in `finish` for the step itself.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct TaskHooks
    {
        /// <summary>sizeof(pbmpm_task_hooks), set by the caller</summary>
        public uint Size;
        /// <summary>1: a task may itself call enqueue and finish. Then a step in the background is one more task, see async.h. 0 (default): it may not</summary>
        public int Nests;
        /// <summary>not null; returns a handle</summary>
        public IntPtr Enqueue;
        /// <summary>not null; any thread may call it</summary>
        public IntPtr Finish;
        /// <summary>passed on unchanged</summary>
        public IntPtr User;
    }

    /// <summary>One line of the library's own table of layouts: a field of a public structure. With an empty field name it is the
    /// structure itself (offset 0, size of the whole). This structure and the identifiers never grow.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct LayoutEntry
    {
        /// <summary>never null</summary>
        public IntPtr Structure;
        /// <summary>never null</summary>
        public IntPtr Field;
        /// <summary>bytes from the start of the structure</summary>
        public uint Offset;
        /// <summary>bytes</summary>
        public uint Size;
    }

    /// <summary>A surface to bake: triangles in 3D, the edges of polygons in 2D. Arrays are read during the call only.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct MeshDef
    {
        /// <summary>sizeof(pbmpm_mesh_def), set by pbmpm_mesh_def_init()</summary>
        public uint Size;
        /// <summary>2 or 3; default 3</summary>
        public int Dimension;
        /// <summary>grid cells along the longest side of the mesh, in [4, 1024]; default 64</summary>
        public int Resolution;
        /// <summary>up to PBMPM_MAX_MESH_VERTICES (hull: PBMPM_MAX_HULL_VERTICES)</summary>
        public uint VertexCount;
        /// <summary>up to PBMPM_MAX_MESH_ELEMENTS (hull: 0)</summary>
        public uint ElementCount;
        /// <summary>vertex_count * dimension floats [m], within 1e6</summary>
        public float* Vertices;
        /// <summary>element_count * dimension indices of vertices. The surface must be closed, and wound one way
        /// throughout (inward or outward). Equal vertices count as one. pbmpm_bake_hull(): null.</summary>
        public uint* Elements;

        /// <summary>The library's defaults.</summary>
        public static MeshDef Default
        {
            get
            {
                Library.Check();
                MeshDef it;
                Library.Require(Methods.pbmpm_mesh_def_init(&it, (UIntPtr)sizeof(MeshDef)));
                return it;
            }
        }
    }

    /// <summary>A surface given by heights over a regular lattice, solid from there down to its base. Sample (i, j) stands at i * spacing[0] and
    /// j * spacing[1] along the axes other than `up` (2D: i alone). Let it go on a cell or two
    /// under walls: where it ends at them, matter may creep. With a grid wider than 1.5 cells of the world matter may slip
    /// down there (PBMPM_ADVICE_COLLIDER_TOO_COARSE).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct HeightsDef
    {
        /// <summary>sizeof(pbmpm_heights_def), set by pbmpm_heights_def_init()</summary>
        public uint Size;
        /// <summary>2 or 3; default 3</summary>
        public int Dimension;
        /// <summary>axis along which heights are measured, in [0, dimension); default 1</summary>
        public int Up;
        /// <summary>grid cells along the longest side, in [4, 1024]; 0 (default): cells as wide as the lattice's</summary>
        public int Resolution;
        /// <summary>samples per axis, at least 2, up to PBMPM_MAX_HEIGHTS in all; 2D: the second is not used</summary>
        public Uint2 Count;
        /// <summary>[m], in [1e-6, 1e6]; default 1</summary>
        public Float2 Spacing;
        /// <summary>how far the base lies below the lowest sample [m], in [1e-6, 1e6]; default 1</summary>
        public float Thickness;
        /// <summary>count[0] * count[1] floats [m], within 1e6; sample (i, j) is heights[i + j * count[0]]</summary>
        public float* Heights;

        /// <summary>The library's defaults.</summary>
        public static HeightsDef Default
        {
            get
            {
                Library.Check();
                HeightsDef it;
                Library.Require(Methods.pbmpm_heights_def_init(&it, (UIntPtr)sizeof(HeightsDef)));
                return it;
            }
        }
    }

    /// <summary>Particles from arrays. Arrays are read during the call only. "d" is the world's dimension.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct ParticlesDef
    {
        /// <summary>sizeof(pbmpm_particles_def), set by pbmpm_particles_def_init()</summary>
        public uint Size;
        /// <summary>number of particles in the arrays</summary>
        public uint Count;
        /// <summary>their material</summary>
        public MaterialId Material;
        /// <summary>rest volume of each particle [m^d]; 0 (default): (dx/2)^d</summary>
        public float Volume;
        /// <summary>count * d floats [m], relative to the origin; inside the domain box if there is one</summary>
        public float* Positions;
        /// <summary>count * d floats [m/s], or null for rest</summary>
        public float* Velocities;
        /// <summary>count floats: rest volumes [m^d], &gt; 0, or null for `volume`</summary>
        public float* Volumes;
        /// <summary>count numbers of the host's, see PBMPM_USER_VALUE; null (default): 0</summary>
        public uint* UserValues;

        /// <summary>The library's defaults.</summary>
        public static ParticlesDef Default
        {
            get
            {
                Library.Check();
                ParticlesDef it;
                Library.Require(Methods.pbmpm_particles_def_init(&it, (UIntPtr)sizeof(ParticlesDef)));
                return it;
            }
        }
    }

    /// <summary>A window on the world's own memory, which stays allocated until the world is destroyed: an expired view never faults. Once it has expired it shows a
    /// mix of old and new values, or 0. Of AFFINE_VELOCITY and DEFORMATION the values
    /// are arbitrary. Publish (async.h) or copy (pbmpm_particles_copy()) what is drawn later, or by another thread. Element (i, c) of the field is at
    /// (const char *)data + i * stride + c * component_stride. Read-only.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct View
    {
        /// <summary>sizeof(pbmpm_view), set by the caller</summary>
        public uint Size;
        /// <summary>particles</summary>
        public uint Count;
        /// <summary>values per particle</summary>
        public uint Components;
        /// <summary>bytes from one component to the next</summary>
        public uint ComponentStride;
        /// <summary>bytes from one particle to the next</summary>
        public ulong Stride;
        /// <summary>null when count is 0</summary>
        public IntPtr Data;
        /// <summary>valid while pbmpm_world_generation() returns this number; of a published state for longer, see async.h</summary>
        public ulong Generation;
    }

    /// <summary>What pbmpm_particles_copy() writes for each particle. Fill it with pbmpm_copy_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct CopyDef
    {
        /// <summary>sizeof(pbmpm_copy_def), set by pbmpm_copy_def_init()</summary>
        public uint Size;
        /// <summary>bytes from one particle to the next, a multiple of 4; 0 (default): what offset and fields take</summary>
        public uint Stride;
        /// <summary>time, from 0 (before the last step) to 1 (default: now). Positions are x - (1 - alpha) dt v with the
        /// duration dt of the last step. They err by up to 0.02 cells, by up to 0.045 where liquid is crowded. Other
        /// fields are those of now.</summary>
        public float Alpha;
        /// <summary>of `fields`; 0 (default): POSITION, VELOCITY, MATERIAL</summary>
        public uint FieldCount;
        /// <summary>one behind the other, without gaps; 4 bytes for each component</summary>
        public Field* Fields;
        /// <summary>1: POSITION and VELOCITY take 3 floats in 2D too, the third is 0; 0 (default): d floats</summary>
        public int PadsVectors;
        /// <summary>bytes from the beginning of a record to the first field, a multiple of 4; default 0</summary>
        public uint Offset;

        /// <summary>The library's defaults.</summary>
        public static CopyDef Default
        {
            get
            {
                Library.Check();
                CopyDef it;
                Library.Require(Methods.pbmpm_copy_def_init(&it, (UIntPtr)sizeof(CopyDef)));
                return it;
            }
        }
    }

    /// <summary>One thing that goes wrong with the present scene and settings.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Advice
    {
        /// <summary>sizeof(pbmpm_advice); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>what</summary>
        public AdviceCode Code;
        /// <summary>whose; all zero: of no material</summary>
        public MaterialId Material;
        /// <summary>whose; all zero: of no obstacle</summary>
        public ColliderId Collider;
        /// <summary>what was found; the code says of what</summary>
        public float Figure;
        /// <summary>the limit that the figure should keep to</summary>
        public float Bound;
        /// <summary>which setting would help</summary>
        public Change Change;
        /// <summary>what to set it to, within the setting's range</summary>
        public float Value;
        /// <summary>what that costs, in percent of a step; negative: not known</summary>
        public float Price;
        /// <summary>1: measured in the present state; 0: foreseen</summary>
        public int CameTrue;
        /// <summary>one sentence, constant, valid as long as the library; never null</summary>
        public IntPtr Text;
    }

    /// <summary>Where a mesh goes. Each pointer may be null: then that is not written, nor worked out. Memory is the caller's; a float or index needs no alignment.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct SurfaceMesh
    {
        /// <summary>sizeof(pbmpm_surface_mesh), set by the caller</summary>
        public uint Size;
        /// <summary>bytes from one vertex to the next, a multiple of 4, in each of the following; 0: they are packed. So all may lie in one record</summary>
        public uint Stride;
        /// <summary>3 floats per vertex [m], relative to the origin</summary>
        public float* Positions;
        /// <summary>3 floats per vertex: unit vector out of the matter, smooth</summary>
        public float* Normals;
        /// <summary>3 floats per vertex [m/s]: the mean of particles near by</summary>
        public float* Velocities;
        /// <summary>def.material_count floats per vertex: the share that each material has of the matter near by. They add up to 1.</summary>
        public float* Weights;
        /// <summary>3 per triangle, counterclockwise from outside, of def.index_bytes each</summary>
        public IntPtr Indices;
        /// <summary>vertices that there is room for, in each of the above</summary>
        public uint VertexCapacity;
        /// <summary>indices that there is room for</summary>
        public uint IndexCapacity;
        /// <summary>out</summary>
        public uint VertexCount;
        /// <summary>out</summary>
        public uint IndexCount;
    }

    /// <summary>Which particles become points, and how they look. Fill it with pbmpm_points_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct PointsDef
    {
        /// <summary>sizeof(pbmpm_points_def), set by pbmpm_points_def_init()</summary>
        public uint Size;
        /// <summary>of `materials`; 0 (default): all</summary>
        public uint MaterialCount;
        /// <summary>whose particles become points, each once</summary>
        public IntPtr Materials;
        /// <summary>the colour of each of `materials`, or null (default): opaque white</summary>
        public uint* Palette;
        /// <summary>1: the colour is PBMPM_USER_VALUE of the particle; 0 (default)</summary>
        public int ColourFromUser;
        /// <summary>in (0, 100]; default 1. Neighbours in a lattice touch at 0.81.</summary>
        public float RadiusScale;
        /// <summary>1: only particles that the surface with the defaults and these materials leaves out, in 3D; 0 (default): all</summary>
        public int SprayOnly;
        /// <summary>0</summary>
        public uint Reserved;

        /// <summary>The library's defaults.</summary>
        public static PointsDef Default
        {
            get
            {
                Library.Check();
                PointsDef it;
                Library.Require(Methods.pbmpm_points_def_init(&it, (UIntPtr)sizeof(PointsDef)));
                return it;
            }
        }
    }

    /// <summary>Receives one line per notable happening. Any thread that calls the library may call it, and a step in the background; several at once, too.
    /// Workers never do. It must not call the library.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void LogCallback(LogLevel level, IntPtr message, IntPtr user);

    /// <summary>Called where an assertion inside the library fails: with the condition, and its place in the sources. It returns 0 if the call is
    /// to go on, though its results mean nothing; with another number abort() is called. Any thread may call it, workers too, and several at once. It must
    /// not call the library.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int AssertCallback(IntPtr condition, IntPtr file, int line, IntPtr user);

    /// <summary>One share of parallel work; `index` counts from 0.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Task(int index, IntPtr context);

    /// <summary>What pbmpm_allocator.allocate points to.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate IntPtr AllocatorAllocate(UIntPtr size, UIntPtr alignment, IntPtr user);

    /// <summary>What pbmpm_allocator.release points to.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void AllocatorRelease(IntPtr memory, UIntPtr size, IntPtr user);

    /// <summary>What pbmpm_task_hooks.enqueue points to.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate IntPtr TaskHooksEnqueue(IntPtr task, int count, IntPtr context, IntPtr user);

    /// <summary>What pbmpm_task_hooks.finish points to.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void TaskHooksFinish(IntPtr handle, IntPtr user);

    /// <summary>The functions of the C library, as they are.</summary>
    public static unsafe class Methods
    {
        /// <summary>The name that the run time looks for; it adds what the platform wants around it. With PBMPM_STATIC: the program.</summary>
        #if PBMPM_STATIC || (!UNITY_EDITOR && (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS || UNITY_WEBGL))
        public const string LibraryName = "__Internal";
        #else
        public const string LibraryName = "pbmpm";
        #endif

        /// <summary>A short constant name of a result ("PBMPM_ERROR_CAPACITY"); never null, never to be freed. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_result_name(Result result);

        /// <summary>The message of the last call that failed on this thread, or an empty string. Valid until the next call that
        /// fails on this thread; never null. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_last_error();

        /// <summary>Sets (or, with null, removes) the process-wide log callback. Any thread; not while another thread is inside the
        /// library. Bindings need not use it: everything it says can also be polled.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_set_log_callback(IntPtr callback, IntPtr user);

        /// <summary>Sets (or, with null, removes) the process-wide callback for assertions. Without one a line goes to standard error, and abort() is called. Any thread; not while
        /// another thread is inside the library.
        /// Errors: UNSUPPORTED: the library was built without assertions (the default; -DPBMPM_ASSERTS=ON builds it with them); then nothing is set.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_set_assert_callback(IntPtr callback, IntPtr user);

        /// <summary>The version of the library that is loaded, as major * 1000000 + minor * 1000 + patch. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_version();

        /// <summary>PBMPM_ABI_VERSION of the library that is loaded; a binding refuses to run when it differs from its own. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_abi_version();

        /// <summary>The kernels in use. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Isa pbmpm_active_isa();

        /// <summary>The name of an instruction set ("AVX2"); never null. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_isa_name(Isa isa);

        /// <summary>1 if this library was built with the CMake option PBMPM_STRICT: the same results with every instruction set, bit for bit; else 0. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern int pbmpm_build_is_strict();

        /// <summary>The layouts of all public structures as this library was compiled. Every binding compares it with its own
        /// mirror when it loads. The table is constant and lives as long as the library. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_layout_table(LayoutEntry** entries, uint* count);

        /// <summary>Destroys all worlds and joins all threads of the library. For hosts that unload the library. Unloading alone does
        /// the same, but leaks the memory of worlds with a host's allocator: that may be gone by then. No other call may
        /// be under way. Afterwards the library may be used again.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shutdown();

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_def_init(MaterialDef* def, UIntPtr size);

        /// <summary>Which kinds of materials this library was built with: bit k (1u &lt;&lt; PBMPM_LIQUID, ...) is set for kind k. What the CMake option
        /// PBMPM_MATERIALS leaves out has no kernels in the library, and creating it is refused as UNSUPPORTED. All kinds but liquids
        /// share the code of the deformation gradient: without any of them it is left out, too. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_materials_built();

        /// <summary>Adds a material to a world. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (kind or size unknown, or the kind is not built), CAPACITY,
        /// BUSY. A material that no particle has costs nothing: neither memory nor time.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_create(WorldId world, MaterialDef* def, MaterialId* material);

        /// <summary>Reads a material. `def-&gt;size` must be set. Errors: INVALID_ID, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_get(WorldId world, MaterialId material, MaterialDef* def);

        /// <summary>How stiff the material is when the world is stepped by `dt` [s] with its present settings. `effective-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null; dt not in (0, 10]), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_effective(WorldId world, MaterialId material, float dt, Effective* effective);

        /// <summary>Changes the parameters of a material (not its kind or density); takes effect with the next step.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_set(WorldId world, MaterialId material, MaterialDef* def);

        /// <summary>Removes a material that no particle uses. Errors: INVALID_ID, IN_USE, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_destroy(WorldId world, MaterialId material);

        /// <summary>Whether an identifier is that of a material of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
        /// error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_is_valid(WorldId world, MaterialId material, int* valid);

        /// <summary>Lists the materials of the world. *count is how many there are; the first `capacity` of them are written to `materials`, which may be null with a
        /// capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_materials(WorldId world, MaterialId* materials, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_mesh_def_init(MeshDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_mesh_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_heights_def_init(HeightsDef* def, UIntPtr size);

        /// <summary>Bakes a closed mesh into the caller's `buffer` of `capacity` bytes. *bytes becomes the size that is needed. With a null buffer the call
        /// only says the size, at once: ask first, then bake. The memory that baking takes is the C library's and is given back. Errors: INVALID_ARGUMENT (a value out of range; a mesh that is open, wound in two ways, or holds no volume: the message
        /// says where), OUT_OF_MEMORY, CAPACITY (the buffer is too small). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_mesh(MeshDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Bakes the convex hull of the vertices. As pbmpm_bake_mesh().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_hull(MeshDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Bakes a body of heights. As pbmpm_bake_mesh().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_heights(HeightsDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Checks the bytes of a baked solid and tells what it is. `info-&gt;size` must be set. Errors: INVALID_ARGUMENT (null), DAMAGED, UNSUPPORTED
        /// (a format of another version). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_inspect(IntPtr data, ulong size, BakedInfo* info);

        /// <summary>Loads a baked solid into a world: a copy in the world's memory. Errors: INVALID_ID, DAMAGED, UNSUPPORTED, INVALID_ARGUMENT (also: its
        /// dimension is not the world's), CAPACITY, OUT_OF_MEMORY, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_create(WorldId world, IntPtr data, ulong size, BakedId* baked);

        /// <summary>What a loaded solid is. `info-&gt;size` must be set. Errors: INVALID_ID, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_get(WorldId world, BakedId baked, BakedInfo* info);

        /// <summary>Takes a solid out of the world. Errors: INVALID_ID; IN_USE (a collider refers to it); BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_destroy(WorldId world, BakedId baked);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shape_init(Shape* shape, UIntPtr size);

        /// <summary>Writes the defaults. `size` is the caller's sizeof(*def).
        /// Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size that no version had). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_def_init(WorldDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_world_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_settings_init(Settings* settings, UIntPtr size);

        /// <summary>Creates a world and takes its memory. On failure *world is the null identifier and nothing is held.
        /// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, CAPACITY (worlds), UNSUPPORTED_CPU, THREAD. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_create(WorldDef* def, WorldId* world);

        /// <summary>Destroys a world and everything in it; views and identifiers of it become invalid.
        /// Errors: INVALID_ID (also on a second destroy), BUSY. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_destroy(WorldId world);

        /// <summary>Whether an identifier is that of a world: *valid is then 1, else 0, which is no error. A world that a step or another thread is at work on is
        /// valid. Errors: INVALID_ARGUMENT (null). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_is_valid(WorldId world, int* valid);

        /// <summary>Lists all worlds of the process. *count is how many there are; the first `capacity` of them are written to `worlds`, which may be null with a
        /// capacity of 0. Another thread may have destroyed one before the call returns. Errors: INVALID_ARGUMENT (null). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_get_worlds(WorldId* worlds, uint capacity, uint* count);

        /// <summary>The definition the world was made from, with origin and domain where pbmpm_world_shift_origin() left them. Its pointers are to copies that live as long as the world. `def-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_def(WorldId world, WorldDef* def);

        /// <summary>Reads the settings. `settings-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.
        /// Any thread, together with others that read.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_settings(WorldId world, Settings* settings);

        /// <summary>Changes the settings. All or nothing. Errors as pbmpm_world_get_settings(), and INVALID_ARGUMENT. Any thread, alone in its world.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_set_settings(WorldId world, Settings* settings);

        /// <summary>Advances the world by `dt` seconds in `substeps` equal parts. Expires all views. Allocates nothing once the number
        /// of occupied blocks has stopped growing. `dt` must be in (0, 10]. A
        /// substep lasts at least 1e-25 s, and at least 1e-25 s per metre of the cell size.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED; OUT_OF_MEMORY when the grid cannot grow. Then the substep that
        /// needed it is not done, earlier ones of the call stay done. Particles may be stored in another order. An F that
        /// was set from outside is brought into its material's range. With PBMPM_SOLVER_CONVERGENT islands that were solved before
        /// those that lacked memory stay where they went. With sleeping, what was at rest may have fallen asleep.
        /// Any thread, alone in its world; different worlds step at the same time.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step(WorldId world, float dt);

        /// <summary>Moves the origin by the multiple of 4 cells that is nearest to `wanted` [m], and writes that to `moved`. For scenes so large that a float
        /// is too coarse for positions. All positions are then relative to the new origin: those of particles, obstacles, emitters, drains and forces, the
        /// domain and the kill bounds. world_def.origin grows by `moved`. Matter goes on bit for bit as it would have. The exception is where it
        /// meets obstacles, walls, emitters, drains, forces or bounds: their positions are rounded to floats. Nothing wakes. Expires all views. In 2D moved[2] is 0. What the host keeps, it moves itself: the
        /// `position` and `point` of a pbmpm_rigid_state. A snapshot from before brings its origin back, but not into a world with a domain: that is FOREIGN.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, NaN, something would be out of its range), BUSY, FORKED: nothing has changed.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_shift_origin(WorldId world, Double3* wanted, Double3* moved);

        /// <summary>A number that changes with every call that moves, adds or removes particles. A view is valid while this number equals
        /// its `generation`. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_generation(WorldId world, ulong* generation);

        /// <summary>64-bit hash of the dynamic state in storage order (position, velocity, affine velocity, J, F, material, mass). Equal for
        /// the same calls on the same binary and instruction set, for any number of threads; of a strict build (pbmpm_build_is_strict()) on any
        /// instruction set.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_hash(WorldId world, ulong* hash);

        /// <summary>Writes the defaults. `size` is the caller's sizeof(*def).
        /// Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size that no version had). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_def_init(ParticlesDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_particles_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_fill_def_init(FillDef* def, UIntPtr size);

        /// <summary>Adds particles. All of them or none. `ids`: null or room for def-&gt;count identifiers.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also NaN, infinity or a position outside the domain in any element), CAPACITY, BUSY;
        /// OUT_OF_MEMORY: the first particle that is not liquid makes room for F, the first user value for user values.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_add(WorldId world, ParticlesDef* def, ParticleId* ids);

        /// <summary>Fills a shape (any kind but PBMPM_PLANE) with a lattice of spacing dx / particles_per_axis that is centred on it; each particle has the rest volume of
        /// one lattice cell. Lattice points outside the domain box are left out, and those in an obstacle that acts on the material.
        /// Particles that are there already do not count: two fills of one place overlap (PBMPM_ADVICE_OVERLAPS).
        /// pbmpm_particles_remove_in() makes room; a collider that is there while you fill leaves its place out.
        /// With a CAPACITY error nothing is added and `added` says how many the shape needs. `added` may be null.
        /// Errors: INVALID_ID; INVALID_ARGUMENT, also where no lattice point is left, or more than 2^30 are around the shape in the
        /// domain; CAPACITY, BUSY; OUT_OF_MEMORY (as above).</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_fill(WorldId world, FillDef* def, Shape* shape, uint* added);

        /// <summary>Removes particles by identifier. An unknown one: INVALID_ID and nothing is removed.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_remove(WorldId world, ParticleId* ids, uint count);

        /// <summary>Removes all particles inside a shape; *removed (may be null) says how many. Errors: INVALID_ID, INVALID_ARGUMENT, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_remove_in(WorldId world, Shape* shape, uint* removed);

        /// <summary>Number of live particles.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_count(WorldId world, uint* count);

        /// <summary>A view of a field. The order of particles is the same in all views of one generation and changes with steps; their
        /// identity is PBMPM_PARTICLE. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (no such field in this world), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_view(WorldId world, Field field, View* view);

        /// <summary>Writes the defaults, as pbmpm_particles_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_copy_def_init(CopyDef* def, UIntPtr size);

        /// <summary>Copies all particles into the caller's memory, for rendering and for uploads to a GPU: it stays readable whatever the world does. `def` may be
        /// null: the defaults. *count is the number of particles; `capacity`: bytes of `buffer`, any alignment. The order is that of views.
        ///
        /// Records for a GPU: with pads_vectors 1 they are the same in 2D and 3D. The default fields take 28 bytes without gaps: position (3 floats),
        /// velocity (3 floats), index of the material (uint32). So a structured buffer of HLSL has them. Fields POSITION, MATERIAL, VELOCITY with stride 32
        /// are {vec3, uint, vec3} of GLSL's std430. What is before `offset` and behind the last field of a record stays the host's.
        ///
        /// A host that steps at a fixed rate draws between two states: `alpha` is the share of the way to the present one. So motion is even on any display.
        /// Expires no view. While a step runs in the background it copies the published state, see async.h.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (null, a value out of range); UNSUPPORTED (size; a field that the world does not have); CAPACITY (the
        /// buffer is too small; nothing is written, *count is set); BUSY (also: a field that is not published, while a step runs).</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_copy(WorldId world, CopyDef* def, IntPtr buffer, ulong capacity, uint* count);

        /// <summary>Writes a field of some particles: count * components values, tightly packed: floats; USER_VALUE: uint32.
        /// Settable: POSITION (velocity stays), VELOCITY, AFFINE_VELOCITY, VOLUME_RATIO (liquid, in [0.05, 1.2]), PRESSURE (liquid, in
        /// [0, 1e30]: where the dual solver starts from), DEFORMATION (elastic, any finite matrix
        /// with entries up to 1e6), USER_VALUE (wakes nothing). With `ids` null the values are for all particles in storage order and `count` must be their number.
        /// All or nothing; expires views. Errors: INVALID_ID; INVALID_ARGUMENT (a value out of range, a field that cannot be set);
        /// UNSUPPORTED (a particle whose material has no such field); OUT_OF_MEMORY (room for PRESSURE or USER_VALUE); BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_set(WorldId world, Field field, ParticleId* ids, uint count, IntPtr values);

        /// <summary>Where particles stand in the current storage order (the row in a view). Errors: INVALID_ID (no row is written), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_find(WorldId world, ParticleId* ids, uint count, uint* rows);

        /// <summary>Particles inside a shape, in storage order. Writes up to `capacity` identifiers; *count is the full number.
        /// `ids` may be null when capacity is 0. Errors: INVALID_ID, INVALID_ARGUMENT, OUT_OF_MEMORY (see query.h), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_shape(WorldId world, Shape* shape, ParticleId* ids, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_def_init(ColliderDef* def, UIntPtr size);

        /// <summary>Adds an obstacle, with the shape's pose at the start. It may stand on top of matter: that is pushed out over the next steps.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_create(WorldId world, ColliderDef* def, Shape* shape, ColliderId* collider);

        /// <summary>Takes an obstacle away. Errors: INVALID_ID, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_destroy(WorldId world, ColliderId collider);

        /// <summary>Whether an identifier is that of a collider of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
        /// error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_is_valid(WorldId world, ColliderId collider, int* valid);

        /// <summary>Lists the colliders of the world. *count is how many there are; the first `capacity` of them are written to `colliders`, which may be null with a
        /// capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_colliders(WorldId world, ColliderId* colliders, uint capacity, uint* count);

        /// <summary>Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not. Errors: INVALID_ID, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_get(WorldId world, ColliderId collider, ColliderDef* def, Shape* shape);

        /// <summary>Changes an obstacle, which keeps its identifier. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller structure lacks.
        /// A new shape is there at once, without velocity. It ends a way that pbmpm_collider_move() asked for; so does `kinematic` 0.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED: nothing has changed.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_set(WorldId world, ColliderId collider, ColliderDef* def, Shape* shape);

        /// <summary>Where a kinematic obstacle shall be at the end of the next step. Its velocity follows from the distance; what
        /// matter feels of it is clamped to settings.max_displacement cells per substep. The pose itself is reached exactly.
        /// `rotation` may be null: unchanged. Errors: INVALID_ID, INVALID_ARGUMENT (also: not kinematic), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_move(WorldId world, ColliderId collider, Float3* position, Float4* rotation);

        /// <summary>Puts an obstacle somewhere at once, without velocity. Works for static ones too. Errors: INVALID_ID,
        /// INVALID_ARGUMENT, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_teleport(WorldId world, ColliderId collider, Float3* position, Float4* rotation);

        /// <summary>Reads the impulse of the last step, summed over its substeps. About another point p: angular + (position - p) x linear.
        /// `impulse-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (it does not measure), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_impulse(WorldId world, ColliderId collider, Impulse* impulse);

        /// <summary>The same for a wall of the domain: that at the lower (`upper` 0) or upper (1) end of an axis. Errors: INVALID_ID, INVALID_ARGUMENT (no such
        /// wall, or world_def.domain_measures_impulse is 0), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_impulse(WorldId world, int axis, int upper, Impulse* impulse);

        /// <summary>Reads a wall: that at the lower (`upper` 0) or upper (1) end of an axis. `wall-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null, or no
        /// such wall: also where world_def.domain_enabled is 0), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_wall_get(WorldId world, int axis, int upper, DomainWall* wall);

        /// <summary>Changes a wall; the next step knows it. Matter that is behind a wall when it closes is put back to it at once: remove it before, see
        /// pbmpm_particles_remove_in(). Wakes all matter. Errors as pbmpm_domain_wall_get().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_wall_set(WorldId world, int axis, int upper, DomainWall* wall);

        /// <summary>Which materials touch the colliders that report touches, and where that has begun or ended since the call before. A particle touches an obstacle
        /// that it is within half a cell of, and a sensor that it is in. Call it once per step: a touch that begins and ends between two calls is not
        /// seen. Nor is the end of the touches of a destroyed collider.
        /// *count is how many touches there are; the first `capacity` of them are written. If there was less room than *count, this call does not count as the call before of the next one.
        /// `touches` may be null with a capacity of 0; else touches[0].size must be set. Costs a look at the particles near those colliders.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_touches(WorldId world, Touch* touches, uint capacity, uint* count);

        /// <summary>Particles inside an obstacle (deeper than 1/100 cell); arguments as in pbmpm_query_shape().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_collider(WorldId world, ColliderId collider, ParticleId* ids, uint capacity, uint* count);

        /// <summary>What will go wrong with the present scene and settings when the world is stepped by `dt` [s]. It also tells what came true in the steps so far. Changes nothing.
        /// What is foreseen comes from formulas and measured limits, for the matter that is there or that emitters bring. An empty list is no promise.
        ///
        /// Writes up to `capacity` records in the order of their codes' numbers, then of materials and obstacles; *count is the full number. `array` may be null when
        /// capacity is 0; otherwise array[0].size must be set. Costs a quarter to a half of a step of five iterations, and only when called.
        /// It takes memory to sort cells, and gives it back.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (null, dt not in (0, 10]); UNSUPPORTED (size); OUT_OF_MEMORY; BUSY; FORKED.
        /// Any thread, alone in its world.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_advice(WorldId world, float dt, Advice* array, uint capacity, uint* count);

        /// <summary>A short constant name of a code ("PBMPM_ADVICE_NO_GRAVITY"); "PBMPM_ADVICE_UNKNOWN" of a number that is none; never null. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_advice_name(AdviceCode code);

        /// <summary>The unit of a code's figure and bound as constant text ("cells"); empty where they have none or a parameter tells it, and of a number that is no code; never null. Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_advice_unit(AdviceCode code);

        /// <summary>Which fields can be viewed while a step runs: `count` of them, each once; 0: none. Until this is called: POSITION, VELOCITY,
        /// MATERIAL and PARTICLE. A published field that the world does not have yet (PRESSURE, DEFORMATION) costs memory, too, though it cannot be
        /// viewed. Takes effect, and memory, with the next pbmpm_world_step_begin().
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null with a count, unknown or repeated field), BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_publish(WorldId world, Field* fields, uint count);

        /// <summary>Begins a step of `dt` seconds and returns. Expires all views. What the previous begin published stays readable until the next
        /// one.
        /// Errors: those of pbmpm_world_step() that its arguments give; BUSY (also: a step is under way); OUT_OF_MEMORY (room for the
        /// published fields), THREAD (no thread for the step): then no step was begun and nothing has changed.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_begin(WorldId world, float dt);

        /// <summary>Ends a step that was begun, and gives its result: what pbmpm_world_step() would have given. With `wait` 0 and a step that is not
        /// done: BUSY, of which the log callback is not told, and the step goes on. With another number it waits. The state that was published stays readable, see above.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (no step is under way), BUSY, FORKED; of the step: OUT_OF_MEMORY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_end(WorldId world, int wait);

        /// <summary>Whether the step that was begun is done, so that pbmpm_world_step_end() will not wait: *done is then 1, else 0. Ends nothing and waits
        /// for nothing; made to be asked in each frame. Where the step is a task of the host and no other thread runs tasks, it
        /// never says yes: there end the step with a wait.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null; no step is under way), BUSY, FORKED: *done is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_done(WorldId world, int* done);

        /// <summary>Lines that show obstacles, regions and the grid. Balls and capsules are drawn as circles of 24 lines, planes as a square of 20 cells (2D: a line)
        /// around their position, baked solids by contours of their surface. `parts`: a sum of pbmpm_debug_part. *count is how many lines there are; the
        /// first `capacity` of them are written to `lines`, which may be null with a capacity of 0. Costs what it draws, and only when called.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, unknown parts), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_debug_lines(WorldId world, uint parts, Line* lines, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_def_init(DrainDef* def, UIntPtr size);

        /// <summary>Adds a drain of any shape. Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_create(WorldId world, DrainDef* def, Shape* shape, DrainId* drain);

        /// <summary>Takes a drain away. Errors: INVALID_ID, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_destroy(WorldId world, DrainId drain);

        /// <summary>Whether an identifier is that of a drain of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
        /// error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_is_valid(WorldId world, DrainId drain, int* valid);

        /// <summary>Lists the drains of the world. *count is how many there are; the first `capacity` of them are written to `drains`, which may be null with a
        /// capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_drains(WorldId world, DrainId* drains, uint capacity, uint* count);

        /// <summary>Reads the definition and the shape. Either may be null; set `size` in what is not. Errors: INVALID_ID, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_get(WorldId world, DrainId drain, DrainDef* def, Shape* shape);

        /// <summary>Changes a drain (its place, too). With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller structure lacks. The counts are kept. Errors as pbmpm_drain_create(), but CAPACITY and OUT_OF_MEMORY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_set(WorldId world, DrainId drain, DrainDef* def, Shape* shape);

        /// <summary>Counts since creation. `status-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_status_get(WorldId world, DrainId drain, DrainStatus* status);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_kill_bounds_init(KillBounds* bounds, UIntPtr size);

        /// <summary>Sets or removes the bounds. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_set_kill_bounds(WorldId world, KillBounds* bounds);

        /// <summary>Reads the bounds. `bounds-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_kill_bounds(WorldId world, KillBounds* bounds);

        /// <summary>The account. `flow-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_flow(WorldId world, Flow* flow);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_def_init(EmitterDef* def, UIntPtr size);

        /// <summary>Adds an emitter; it begins with the next step. `shape`: any kind but PBMPM_PLANE; its bounds hold at most 2^22 cells and lie within
        /// 2^21 cells of the origin. Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY,
        /// OUT_OF_MEMORY, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_create(WorldId world, EmitterDef* def, Shape* shape, EmitterId* emitter);

        /// <summary>Takes an emitter away; its particles stay. Errors: INVALID_ID, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_destroy(WorldId world, EmitterId emitter);

        /// <summary>Whether an identifier is that of an emitter of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
        /// error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_is_valid(WorldId world, EmitterId emitter, int* valid);

        /// <summary>Lists the emitters of the world. *count is how many there are; the first `capacity` of them are written to `emitters`, which may be null with a
        /// capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_emitters(WorldId world, EmitterId* emitters, uint capacity, uint* count);

        /// <summary>Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not. Errors: INVALID_ID,
        /// UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_get(WorldId world, EmitterId emitter, EmitterDef* def, Shape* shape);

        /// <summary>Changes an emitter. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller structure lacks. The counts are kept, and so is the fraction of a particle that was due. A new pose is taken at once.
        /// Errors as pbmpm_emitter_create(), but CAPACITY and OUT_OF_MEMORY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_set(WorldId world, EmitterId emitter, EmitterDef* def, Shape* shape);

        /// <summary>Where the emitter shall be at the end of the next step; particles are born all along the way. They do not take on its
        /// motion. If the path crosses more than 2^22 nodes of the domain per substep the emitter jumps. `rotation` may be null: unchanged. Errors: INVALID_ID, INVALID_ARGUMENT, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_move(WorldId world, EmitterId emitter, Float3* position, Float4* rotation);

        /// <summary>Counts since creation. `status-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_status_get(WorldId world, EmitterId emitter, EmitterStatus* status);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_def_init(ForceDef* def, UIntPtr size);

        /// <summary>Adds a force that is felt around a shape of any kind. Errors: INVALID_ID, INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_create(WorldId world, ForceDef* def, Shape* shape, ForceId* force);

        /// <summary>Takes a force away. Errors: INVALID_ID, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_destroy(WorldId world, ForceId force);

        /// <summary>Whether an identifier is that of a force of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
        /// error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_is_valid(WorldId world, ForceId force, int* valid);

        /// <summary>Lists the forces of the world. *count is how many there are; the first `capacity` of them are written to `forces`, which may be null with a
        /// capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_forces(WorldId world, ForceId* forces, uint capacity, uint* count);

        /// <summary>Reads the definition and the shape. Either may be null; set `size` in what is not. Errors: INVALID_ID, UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_get(WorldId world, ForceId force, ForceDef* def, Shape* shape);

        /// <summary>Changes a force (its kind and place, too); takes effect with the next step. A null `def` or `shape` stays as it is, and so does what the
        /// caller's version of one lacks. Errors as pbmpm_force_create(), but CAPACITY and
        /// OUT_OF_MEMORY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_set(WorldId world, ForceId force, ForceDef* def, Shape* shape);

        /// <summary>Figures of the last step. `status-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_status_get(WorldId world, ForceId force, ForceStatus* status);

        /// <summary>What is inside a shape, by material: one entry for each material that has particles there, in the order of their indices.
        /// Writes up to `capacity` entries; *count is the full number. `shares` may be null when capacity is 0; otherwise shares[0].size must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_region(WorldId world, Shape* shape, RegionShare* shares, uint capacity, uint* count);

        /// <summary>Fields at points. `points`: count * d floats [m]. Each of the others may be null:
        /// `filling`: count floats, as defined above;
        /// `density`: count floats, sum_p m_p W_p / dx^d [kg/m^3] (2D: kg/m^2);
        /// `velocity`: count * d floats, sum_p m_p W_p (v_p + C_p (x - x_p)) / sum_p m_p W_p [m/s], C_p the affine velocity; 0 where
        /// there is no matter. A velocity that is linear in x comes out exactly.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null points, a coordinate that is not finite), OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_points(WorldId world, float* points, uint count, float* filling, float* density, float* velocity);

        /// <summary>The highest matter over (or under) points. "Up" is the unit vector u along `direction` (d floats, any length above 1e-6). If that
        /// is null, it is against gravity. On the line through a point x, take the samples x + k dx/4 u for all integers k. The surface is the highest one where the
        /// filling reaches `level`, moved up by 12 halvings towards the next sample. heights[i] is its coordinate
        /// along u, u . x [m], so with u = +y it is its y; -infinity where the line meets no matter.
        /// `points`: count * d floats [m]; `level`: in (0, 100], 0.5 is the surface.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: null direction without gravity), OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_heights(WorldId world, float* points, uint count, float* direction, float level, float* heights);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_ray_init(Ray* ray, UIntPtr size);

        /// <summary>The first point along a ray where the filling reaches the level. Samples lie dx/4 apart, the first one at the origin; the way
        /// from the last sample below the level to the first one that reaches it is halved 12 times. A ray that begins in matter
        /// hits at distance 0. `hit-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_ray(WorldId world, Ray* ray, RayHit* hit);

        /// <summary>Mass properties of a shape. Boxes, balls and capsules: exact. Baked solids: sums over the nodes of the grid, in which a cell that the surface
        /// crosses counts by its share; a solid 64 cells long errs by less than 1/100. `mass-&gt;size` must be set.
        /// `density`: [kg/m^3], in [1e-6, 1e9]. Errors: INVALID_ID, INVALID_ARGUMENT (also: a plane, which has no volume), UNSUPPORTED, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shape_mass(WorldId world, Shape* shape, float density, MassProperties* mass);

        /// <summary>How much of an obstacle is under matter. The surface of the matter around it is continued through the obstacle as a plane; what lies on the
        /// matter's side is under. No gravity is needed, and the plane may lie at any slope. `material` may be null: all matter counts, also what lies on it; else that material alone.
        /// So name the liquid where a raft carries a load of another material.
        ///
        /// Measured on a lattice of the world's cells around the obstacle. Where that is longer than 64 cells the lattice is wider. Matter at a node is the
        /// filling of query.h, divided by the share that obstacles and walls leave open there. Where they leave nothing open, the nodes next to it count.
        /// For obstacles 8 cells long the volume errs by less than 0.4 cells of depth. On a floor it errs by less than 0.8. A thin jet at one side counts for
        /// nothing. But under a film of half a cell or more nearly all of the obstacle counts, see docs/limits.md.
        /// `submersion-&gt;size` must be set. The first call of a world takes memory, later ones that need no more take none.
        /// Errors: INVALID_ID (also: the material), INVALID_ARGUMENT (also: a plane), UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_submerged(WorldId world, ColliderId collider, MaterialId* material, Submersion* submersion);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_def_init(RigidDef* def, UIntPtr size);

        /// <summary>Begins a body at rest where its obstacle is, and notes what holds it there as `point`. `state-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: the obstacle is a plane, not kinematic or measures no impulse), UNSUPPORTED, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_begin(WorldId world, ColliderId collider, RigidDef* def, RigidState* state);

        /// <summary>Moves a body on by a step of `dt` seconds, as pbmpm_world_step() takes it, and its obstacle by pbmpm_collider_move(). Call it once before each
        /// step; a second call would give the last step's impulse again. Only `state` and the obstacle's target change, and nothing on failure.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: as pbmpm_rigid_begin(), and a place out of range), UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_advance(WorldId world, ColliderId collider, RigidDef* def, RigidState* state, float dt);

        /// <summary>Wakes all blocks within two cells of a shape, or all blocks of the world if `shape` is null. They stay awake for another
        /// sleep_time at least. Needed only where something happens that the library cannot know of. Does nothing in a world that does not sleep.
        /// `shape-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY. Any thread, alone in its world.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_wake(WorldId world, Shape* shape);

        /// <summary>How large a snapshot is now. *bytes changes with the particles and their fields only. `bytes_per_particle` may be null.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Any thread, together with others that read.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_size(WorldId world, ulong* bytes, uint* bytesPerParticle);

        /// <summary>Writes a snapshot into the caller's memory, of any alignment. `capacity`: bytes there; *bytes (may be null): how many are
        /// needed, also on CAPACITY, and written otherwise. Takes no memory of the world and expires no views.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), CAPACITY (less room than pbmpm_snapshot_size() says; nothing is written),
        /// BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_save(WorldId world, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Puts a world back into the state of a snapshot. `bytes`: as many as were written, or more. Everything is checked first: on
        /// failure nothing has changed. All particles of before are gone; identifiers of particles are those of the snapshot, and
        /// live in every world that it was restored into. Identifiers of materials and colliders stay the world's own: they
        /// correspond by index. Views expire, events are cleared, and the figures of the last step are 0 until the next one.
        ///
        /// The world must have the dimension, cell size and domain box of the snapshot's; the same materials with the same
        /// parameters; colliders of the same shape, friction and kind; as many emitters, drains and forces; and room for the particles and their
        /// identifiers. Settings are the snapshot's: read them before and set them again to keep one's own.
        ///
        /// `flags`: 0, or PBMPM_RESTORE_KEEP_PARAMETERS. Then these may differ and stay the world's: settings, kill bounds, walls of the domain, colliders, and materials
        /// but for their kind and density; also the definitions of emitters, drains and forces. Poses, counts and which of them are enabled come
        /// from the snapshot. Objects that only the world has stay as they are. Objects that only the snapshot has are left out; a material that particles
        /// need must be there. All matter is awake.
        ///
        /// Errors: DAMAGED (truncated, a byte has changed, or no snapshot at all); FOREIGN (another kind of world, or another version
        /// of the format); CAPACITY (particles or identifiers); OUT_OF_MEMORY (fields that the world has not used yet);
        /// INVALID_ID, INVALID_ARGUMENT (null, unknown flags), BUSY, FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_restore(WorldId world, IntPtr snapshot, ulong bytes, uint flags);

        /// <summary>All figures, of the last step and of the present state. The latter take a pass over the particles on the world's threads. Sums do not
        /// depend on the number of threads. Before the first step times and step counts are 0. `stats-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Any thread, together with others that read.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_stats(WorldId world, Stats* stats);

        /// <summary>The figures that a step leaves behind, without a pass over anything: made to be asked in each frame. These need a pass and are 0:
        /// volume_error_rms, volume_error_max, max_speed, mass, momentum, angular_momentum, kinetic_energy, potential_energy and lane_occupancy.
        /// While a step runs in the background they are those of the step before it, see async.h.
        /// Errors: as pbmpm_world_get_stats(). Any thread, together with others that read.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_step_stats(WorldId world, Stats* stats);

        /// <summary>Events of the last step, and of calls since then. Writes up to `capacity` of them; *count is the number that the world keeps, at most
        /// PBMPM_MAX_EVENTS; *missed (may be null) counts those that it had no room to keep: totals are in pbmpm_stats. `events` may be null when
        /// capacity is 0; otherwise events[0].size must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_events(WorldId world, Event* events, uint capacity, uint* count, uint* missed);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_surface_def_init(SurfaceDef* def, UIntPtr size);

        /// <summary>Makes the surface. `def` may be null: the defaults. With all pointers null it only counts. A host whose buffers were too small enlarges them and calls again:
        /// what the first call worked out is kept.
        ///
        /// Spray is no part of it: particles that are alone, and drops of less than a cell with nothing else within some 4 cells. pbmpm_surface_points() with
        /// spray_only has them.
        /// Errors: INVALID_ID (also: a material); INVALID_ARGUMENT (null, a value out of range, weights without materials); CAPACITY: the buffers are too small, or there are more
        /// vertices than indices of 2 bytes can tell apart. Then only the counts are written. UNSUPPORTED (size; the world is in 2D); OUT_OF_MEMORY; BUSY (also: another thread
        /// makes a surface of this world, or a step runs in the background); FORKED.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_surface_extract(WorldId world, SurfaceDef* def, SurfaceMesh* mesh);

        /// <summary>Writes the defaults, as pbmpm_surface_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_points_def_init(PointsDef* def, UIntPtr size);

        /// <summary>Particles as points for splatting, in the order of views. `def` may be null: the defaults. *count is how many there are; `points` has room for `capacity`.
        /// Errors: as pbmpm_surface_extract(); in 2D UNSUPPORTED only with spray_only. CAPACITY: nothing is written but *count.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_surface_points(WorldId world, PointsDef* def, Point* points, uint capacity, uint* count);
    }

    /// <summary>Where the fields of the structures above lie.</summary>
    internal static unsafe class Mirror
    {
        /// <summary>All fields of all structures; a structure follows its fields.</summary>
        internal static List<MirrorField> All()
        {
            var fields = new List<MirrorField>();
            WorldId(fields);
            MaterialId(fields);
            ColliderId(fields);
            ParticleId(fields);
            Allocator(fields);
            TaskHooks(fields);
            LayoutEntry(fields);
            MaterialDef(fields);
            Effective(fields);
            MeshDef(fields);
            HeightsDef(fields);
            BakedInfo(fields);
            BakedId(fields);
            Shape(fields);
            WorldDef(fields);
            Settings(fields);
            ParticlesDef(fields);
            FillDef(fields);
            View(fields);
            CopyDef(fields);
            ColliderDef(fields);
            Impulse(fields);
            DomainWall(fields);
            Touch(fields);
            Advice(fields);
            Line(fields);
            DrainId(fields);
            DrainDef(fields);
            DrainStatus(fields);
            KillBounds(fields);
            Flow(fields);
            EmitterId(fields);
            EmitterDef(fields);
            EmitterStatus(fields);
            ForceId(fields);
            ForceDef(fields);
            ForceStatus(fields);
            RegionShare(fields);
            Ray(fields);
            RayHit(fields);
            MassProperties(fields);
            Submersion(fields);
            RigidDef(fields);
            RigidState(fields);
            Stats(fields);
            Event(fields);
            SurfaceDef(fields);
            SurfaceMesh(fields);
            Point(fields);
            PointsDef(fields);
            return fields;
        }

        static void WorldId(List<MirrorField> fields)
        {
            var it = default(WorldId);
            fields.Add(new MirrorField("pbmpm_world_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_world_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_world_id", "", &it, &it, &it + 1, false));
        }

        static void MaterialId(List<MirrorField> fields)
        {
            var it = default(MaterialId);
            fields.Add(new MirrorField("pbmpm_material_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_material_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_material_id", "", &it, &it, &it + 1, false));
        }

        static void ColliderId(List<MirrorField> fields)
        {
            var it = default(ColliderId);
            fields.Add(new MirrorField("pbmpm_collider_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_id", "", &it, &it, &it + 1, false));
        }

        static void ParticleId(List<MirrorField> fields)
        {
            var it = default(ParticleId);
            fields.Add(new MirrorField("pbmpm_particle_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_particle_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_particle_id", "", &it, &it, &it + 1, false));
        }

        static void Allocator(List<MirrorField> fields)
        {
            var it = default(Allocator);
            fields.Add(new MirrorField("pbmpm_allocator", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_allocator", "allocate", &it, &it.Allocate, &it.Allocate + 1, false));
            fields.Add(new MirrorField("pbmpm_allocator", "release", &it, &it.Release, &it.Release + 1, false));
            fields.Add(new MirrorField("pbmpm_allocator", "user", &it, &it.User, &it.User + 1, false));
            fields.Add(new MirrorField("pbmpm_allocator", "", &it, &it, &it + 1, true));
        }

        static void TaskHooks(List<MirrorField> fields)
        {
            var it = default(TaskHooks);
            fields.Add(new MirrorField("pbmpm_task_hooks", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_task_hooks", "nests", &it, &it.Nests, &it.Nests + 1, false));
            fields.Add(new MirrorField("pbmpm_task_hooks", "enqueue", &it, &it.Enqueue, &it.Enqueue + 1, false));
            fields.Add(new MirrorField("pbmpm_task_hooks", "finish", &it, &it.Finish, &it.Finish + 1, false));
            fields.Add(new MirrorField("pbmpm_task_hooks", "user", &it, &it.User, &it.User + 1, false));
            fields.Add(new MirrorField("pbmpm_task_hooks", "", &it, &it, &it + 1, true));
        }

        static void LayoutEntry(List<MirrorField> fields)
        {
            var it = default(LayoutEntry);
            fields.Add(new MirrorField("pbmpm_layout_entry", "structure", &it, &it.Structure, &it.Structure + 1, false));
            fields.Add(new MirrorField("pbmpm_layout_entry", "field", &it, &it.Field, &it.Field + 1, false));
            fields.Add(new MirrorField("pbmpm_layout_entry", "offset", &it, &it.Offset, &it.Offset + 1, false));
            fields.Add(new MirrorField("pbmpm_layout_entry", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_layout_entry", "", &it, &it, &it + 1, false));
        }

        static void MaterialDef(List<MirrorField> fields)
        {
            var it = default(MaterialDef);
            fields.Add(new MirrorField("pbmpm_material_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "kind", &it, &it.Kind, &it.Kind + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "density", &it, &it.Density, &it.Density + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "relaxation", &it, &it.Relaxation, &it.Relaxation + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "viscosity", &it, &it.Viscosity, &it.Viscosity + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "volume_feedback", &it, &it.VolumeFeedback, &it.VolumeFeedback + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "elasticity_ratio", &it, &it.ElasticityRatio, &it.ElasticityRatio + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "strain_policy", &it, &it.StrainPolicy, &it.StrainPolicy + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "strain_min", &it, &it.StrainMin, &it.StrainMin + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "strain_max", &it, &it.StrainMax, &it.StrainMax + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "condition_max", &it, &it.ConditionMax, &it.ConditionMax + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "rebound_max", &it, &it.ReboundMax, &it.ReboundMax + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "bulk_modulus", &it, &it.BulkModulus, &it.BulkModulus + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "kinematic_viscosity", &it, &it.KinematicViscosity, &it.KinematicViscosity + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "elastic_model", &it, &it.ElasticModel, &it.ElasticModel + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "young_modulus", &it, &it.YoungModulus, &it.YoungModulus + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "poisson_ratio", &it, &it.PoissonRatio, &it.PoissonRatio + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "friction_angle", &it, &it.FrictionAngle, &it.FrictionAngle + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "cohesion", &it, &it.Cohesion, &it.Cohesion + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "volume_correction", &it, &it.VolumeCorrection, &it.VolumeCorrection + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "yield_strain", &it, &it.YieldStrain, &it.YieldStrain + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "flow_rate", &it, &it.FlowRate, &it.FlowRate + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "key", &it, &it.Key, &it.Key + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "groups", &it, &it.Groups, &it.Groups + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_material_def", "", &it, &it, &it + 1, true));
        }

        static void Effective(List<MirrorField> fields)
        {
            var it = default(Effective);
            fields.Add(new MirrorField("pbmpm_effective", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_effective", "bulk_modulus", &it, &it.BulkModulus, &it.BulkModulus + 1, false));
            fields.Add(new MirrorField("pbmpm_effective", "young_modulus", &it, &it.YoungModulus, &it.YoungModulus + 1, false));
            fields.Add(new MirrorField("pbmpm_effective", "kinematic_viscosity", &it, &it.KinematicViscosity, &it.KinematicViscosity + 1, false));
            fields.Add(new MirrorField("pbmpm_effective", "courant", &it, &it.Courant, &it.Courant + 1, false));
            fields.Add(new MirrorField("pbmpm_effective", "", &it, &it, &it + 1, true));
        }

        static void MeshDef(List<MirrorField> fields)
        {
            var it = default(MeshDef);
            fields.Add(new MirrorField("pbmpm_mesh_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "dimension", &it, &it.Dimension, &it.Dimension + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "resolution", &it, &it.Resolution, &it.Resolution + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "vertex_count", &it, &it.VertexCount, &it.VertexCount + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "element_count", &it, &it.ElementCount, &it.ElementCount + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "vertices", &it, &it.Vertices, &it.Vertices + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "elements", &it, &it.Elements, &it.Elements + 1, false));
            fields.Add(new MirrorField("pbmpm_mesh_def", "", &it, &it, &it + 1, true));
        }

        static void HeightsDef(List<MirrorField> fields)
        {
            var it = default(HeightsDef);
            fields.Add(new MirrorField("pbmpm_heights_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "dimension", &it, &it.Dimension, &it.Dimension + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "up", &it, &it.Up, &it.Up + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "resolution", &it, &it.Resolution, &it.Resolution + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "spacing", &it, &it.Spacing, &it.Spacing + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "thickness", &it, &it.Thickness, &it.Thickness + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "heights", &it, &it.Heights, &it.Heights + 1, false));
            fields.Add(new MirrorField("pbmpm_heights_def", "", &it, &it, &it + 1, true));
        }

        static void BakedInfo(List<MirrorField> fields)
        {
            var it = default(BakedInfo);
            fields.Add(new MirrorField("pbmpm_baked_info", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "dimension", &it, &it.Dimension, &it.Dimension + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "spacing", &it, &it.Spacing, &it.Spacing + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "minimum", &it, &it.Minimum, &it.Minimum + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "maximum", &it, &it.Maximum, &it.Maximum + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "bytes", &it, &it.Bytes, &it.Bytes + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_info", "", &it, &it, &it + 1, true));
        }

        static void BakedId(List<MirrorField> fields)
        {
            var it = default(BakedId);
            fields.Add(new MirrorField("pbmpm_baked_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_baked_id", "", &it, &it, &it + 1, false));
        }

        static void Shape(List<MirrorField> fields)
        {
            var it = default(Shape);
            fields.Add(new MirrorField("pbmpm_shape", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "kind", &it, &it.Kind, &it.Kind + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "position", &it, &it.Position, &it.Position + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "rotation", &it, &it.Rotation, &it.Rotation + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "half_extents", &it, &it.HalfExtents, &it.HalfExtents + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "radius", &it, &it.Radius, &it.Radius + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "normal", &it, &it.Normal, &it.Normal + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "baked", &it, &it.Baked, &it.Baked + 1, false));
            fields.Add(new MirrorField("pbmpm_shape", "", &it, &it, &it + 1, true));
        }

        static void WorldDef(List<MirrorField> fields)
        {
            var it = default(WorldDef);
            fields.Add(new MirrorField("pbmpm_world_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "dimension", &it, &it.Dimension, &it.Dimension + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "cell_size", &it, &it.CellSize, &it.CellSize + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "particle_capacity", &it, &it.ParticleCapacity, &it.ParticleCapacity + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "origin", &it, &it.Origin, &it.Origin + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "memory_budget", &it, &it.MemoryBudget, &it.MemoryBudget + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "thread_count", &it, &it.ThreadCount, &it.ThreadCount + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "domain_enabled", &it, &it.DomainEnabled, &it.DomainEnabled + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "domain_min", &it, &it.DomainMin, &it.DomainMin + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "domain_max", &it, &it.DomainMax, &it.DomainMax + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "domain_friction", &it, &it.DomainFriction, &it.DomainFriction + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "domain_measures_impulse", &it, &it.DomainMeasuresImpulse, &it.DomainMeasuresImpulse + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "allocator", &it, &it.Allocator, &it.Allocator + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "tasks", &it, &it.Tasks, &it.Tasks + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_world_def", "", &it, &it, &it + 1, true));
        }

        static void Settings(List<MirrorField> fields)
        {
            var it = default(Settings);
            fields.Add(new MirrorField("pbmpm_settings", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "substeps", &it, &it.Substeps, &it.Substeps + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "iterations", &it, &it.Iterations, &it.Iterations + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "gravity", &it, &it.Gravity, &it.Gravity + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "max_displacement", &it, &it.MaxDisplacement, &it.MaxDisplacement + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "solver", &it, &it.Solver, &it.Solver + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "pressure", &it, &it.Pressure, &it.Pressure + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "integrator", &it, &it.Integrator, &it.Integrator + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "flip", &it, &it.Flip, &it.Flip + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "target_error", &it, &it.TargetError, &it.TargetError + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "time_budget_ms", &it, &it.TimeBudgetMs, &it.TimeBudgetMs + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "sleeping", &it, &it.Sleeping, &it.Sleeping + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "sleep_speed", &it, &it.SleepSpeed, &it.SleepSpeed + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "sleep_time", &it, &it.SleepTime, &it.SleepTime + 1, false));
            fields.Add(new MirrorField("pbmpm_settings", "", &it, &it, &it + 1, true));
        }

        static void ParticlesDef(List<MirrorField> fields)
        {
            var it = default(ParticlesDef);
            fields.Add(new MirrorField("pbmpm_particles_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "volume", &it, &it.Volume, &it.Volume + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "positions", &it, &it.Positions, &it.Positions + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "velocities", &it, &it.Velocities, &it.Velocities + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "volumes", &it, &it.Volumes, &it.Volumes + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "user_values", &it, &it.UserValues, &it.UserValues + 1, false));
            fields.Add(new MirrorField("pbmpm_particles_def", "", &it, &it, &it + 1, true));
        }

        static void FillDef(List<MirrorField> fields)
        {
            var it = default(FillDef);
            fields.Add(new MirrorField("pbmpm_fill_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "seed", &it, &it.Seed, &it.Seed + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "particles_per_axis", &it, &it.ParticlesPerAxis, &it.ParticlesPerAxis + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "jitter", &it, &it.Jitter, &it.Jitter + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "velocity", &it, &it.Velocity, &it.Velocity + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "user_value", &it, &it.UserValue, &it.UserValue + 1, false));
            fields.Add(new MirrorField("pbmpm_fill_def", "", &it, &it, &it + 1, true));
        }

        static void View(List<MirrorField> fields)
        {
            var it = default(View);
            fields.Add(new MirrorField("pbmpm_view", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "components", &it, &it.Components, &it.Components + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "component_stride", &it, &it.ComponentStride, &it.ComponentStride + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "stride", &it, &it.Stride, &it.Stride + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "data", &it, &it.Data, &it.Data + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_view", "", &it, &it, &it + 1, true));
        }

        static void CopyDef(List<MirrorField> fields)
        {
            var it = default(CopyDef);
            fields.Add(new MirrorField("pbmpm_copy_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "stride", &it, &it.Stride, &it.Stride + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "alpha", &it, &it.Alpha, &it.Alpha + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "field_count", &it, &it.FieldCount, &it.FieldCount + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "fields", &it, &it.Fields, &it.Fields + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "pads_vectors", &it, &it.PadsVectors, &it.PadsVectors + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "offset", &it, &it.Offset, &it.Offset + 1, false));
            fields.Add(new MirrorField("pbmpm_copy_def", "", &it, &it, &it + 1, true));
        }

        static void ColliderDef(List<MirrorField> fields)
        {
            var it = default(ColliderDef);
            fields.Add(new MirrorField("pbmpm_collider_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "friction", &it, &it.Friction, &it.Friction + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "friction_coefficient", &it, &it.FrictionCoefficient, &it.FrictionCoefficient + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "kinematic", &it, &it.Kinematic, &it.Kinematic + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "measures_impulse", &it, &it.MeasuresImpulse, &it.MeasuresImpulse + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "meets", &it, &it.Meets, &it.Meets + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "key", &it, &it.Key, &it.Key + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "sensor", &it, &it.Sensor, &it.Sensor + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "reports_touches", &it, &it.ReportsTouches, &it.ReportsTouches + 1, false));
            fields.Add(new MirrorField("pbmpm_collider_def", "", &it, &it, &it + 1, true));
        }

        static void Impulse(List<MirrorField> fields)
        {
            var it = default(Impulse);
            fields.Add(new MirrorField("pbmpm_impulse", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_impulse", "linear", &it, &it.Linear, &it.Linear + 1, false));
            fields.Add(new MirrorField("pbmpm_impulse", "angular", &it, &it.Angular, &it.Angular + 1, false));
            fields.Add(new MirrorField("pbmpm_impulse", "", &it, &it, &it + 1, true));
        }

        static void DomainWall(List<MirrorField> fields)
        {
            var it = default(DomainWall);
            fields.Add(new MirrorField("pbmpm_domain_wall", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_domain_wall", "open", &it, &it.Open, &it.Open + 1, false));
            fields.Add(new MirrorField("pbmpm_domain_wall", "friction", &it, &it.Friction, &it.Friction + 1, false));
            fields.Add(new MirrorField("pbmpm_domain_wall", "friction_coefficient", &it, &it.FrictionCoefficient, &it.FrictionCoefficient + 1, false));
            fields.Add(new MirrorField("pbmpm_domain_wall", "", &it, &it, &it + 1, true));
        }

        static void Touch(List<MirrorField> fields)
        {
            var it = default(Touch);
            fields.Add(new MirrorField("pbmpm_touch", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "state", &it, &it.State, &it.State + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "collider", &it, &it.Collider, &it.Collider + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "particles", &it, &it.Particles, &it.Particles + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "impulse", &it, &it.Impulse, &it.Impulse + 1, false));
            fields.Add(new MirrorField("pbmpm_touch", "", &it, &it, &it + 1, true));
        }

        static void Advice(List<MirrorField> fields)
        {
            var it = default(Advice);
            fields.Add(new MirrorField("pbmpm_advice", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "code", &it, &it.Code, &it.Code + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "collider", &it, &it.Collider, &it.Collider + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "figure", &it, &it.Figure, &it.Figure + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "bound", &it, &it.Bound, &it.Bound + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "change", &it, &it.Change, &it.Change + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "value", &it, &it.Value, &it.Value + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "price", &it, &it.Price, &it.Price + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "came_true", &it, &it.CameTrue, &it.CameTrue + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "text", &it, &it.Text, &it.Text + 1, false));
            fields.Add(new MirrorField("pbmpm_advice", "", &it, &it, &it + 1, true));
        }

        static void Line(List<MirrorField> fields)
        {
            var it = default(Line);
            fields.Add(new MirrorField("pbmpm_line", "from", &it, &it.From, &it.From + 1, false));
            fields.Add(new MirrorField("pbmpm_line", "to", &it, &it.To, &it.To + 1, false));
            fields.Add(new MirrorField("pbmpm_line", "part", &it, &it.Part, &it.Part + 1, false));
            fields.Add(new MirrorField("pbmpm_line", "", &it, &it, &it + 1, false));
        }

        static void DrainId(List<MirrorField> fields)
        {
            var it = default(DrainId);
            fields.Add(new MirrorField("pbmpm_drain_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_id", "", &it, &it, &it + 1, false));
        }

        static void DrainDef(List<MirrorField> fields)
        {
            var it = default(DrainDef);
            fields.Add(new MirrorField("pbmpm_drain_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_def", "enabled", &it, &it.Enabled, &it.Enabled + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_def", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_def", "key", &it, &it.Key, &it.Key + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_def", "", &it, &it, &it + 1, true));
        }

        static void DrainStatus(List<MirrorField> fields)
        {
            var it = default(DrainStatus);
            fields.Add(new MirrorField("pbmpm_drain_status", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_status", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_status", "drained", &it, &it.Drained, &it.Drained + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_status", "drained_mass", &it, &it.DrainedMass, &it.DrainedMass + 1, false));
            fields.Add(new MirrorField("pbmpm_drain_status", "", &it, &it, &it + 1, true));
        }

        static void KillBounds(List<MirrorField> fields)
        {
            var it = default(KillBounds);
            fields.Add(new MirrorField("pbmpm_kill_bounds", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_kill_bounds", "enabled", &it, &it.Enabled, &it.Enabled + 1, false));
            fields.Add(new MirrorField("pbmpm_kill_bounds", "low", &it, &it.Low, &it.Low + 1, false));
            fields.Add(new MirrorField("pbmpm_kill_bounds", "high", &it, &it.High, &it.High + 1, false));
            fields.Add(new MirrorField("pbmpm_kill_bounds", "", &it, &it, &it + 1, true));
        }

        static void Flow(List<MirrorField> fields)
        {
            var it = default(Flow);
            fields.Add(new MirrorField("pbmpm_flow", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "emitted", &it, &it.Emitted, &it.Emitted + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "refused", &it, &it.Refused, &it.Refused + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "drained", &it, &it.Drained, &it.Drained + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "killed", &it, &it.Killed, &it.Killed + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "emitted_mass", &it, &it.EmittedMass, &it.EmittedMass + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "drained_mass", &it, &it.DrainedMass, &it.DrainedMass + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "killed_mass", &it, &it.KilledMass, &it.KilledMass + 1, false));
            fields.Add(new MirrorField("pbmpm_flow", "", &it, &it, &it + 1, true));
        }

        static void EmitterId(List<MirrorField> fields)
        {
            var it = default(EmitterId);
            fields.Add(new MirrorField("pbmpm_emitter_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_id", "", &it, &it, &it + 1, false));
        }

        static void EmitterDef(List<MirrorField> fields)
        {
            var it = default(EmitterDef);
            fields.Add(new MirrorField("pbmpm_emitter_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "seed", &it, &it.Seed, &it.Seed + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "region", &it, &it.Region, &it.Region + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "enabled", &it, &it.Enabled, &it.Enabled + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "rate", &it, &it.Rate, &it.Rate + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "speed", &it, &it.Speed, &it.Speed + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "direction", &it, &it.Direction, &it.Direction + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "spread", &it, &it.Spread, &it.Spread + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "particles_per_axis", &it, &it.ParticlesPerAxis, &it.ParticlesPerAxis + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "fill_limit", &it, &it.FillLimit, &it.FillLimit + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "budget", &it, &it.Budget, &it.Budget + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "key", &it, &it.Key, &it.Key + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "user_value", &it, &it.UserValue, &it.UserValue + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_def", "", &it, &it, &it + 1, true));
        }

        static void EmitterStatus(List<MirrorField> fields)
        {
            var it = default(EmitterStatus);
            fields.Add(new MirrorField("pbmpm_emitter_status", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "emitted", &it, &it.Emitted, &it.Emitted + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "emitted_mass", &it, &it.EmittedMass, &it.EmittedMass + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "refused_full", &it, &it.RefusedFull, &it.RefusedFull + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "refused_budget", &it, &it.RefusedBudget, &it.RefusedBudget + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "refused_capacity", &it, &it.RefusedCapacity, &it.RefusedCapacity + 1, false));
            fields.Add(new MirrorField("pbmpm_emitter_status", "", &it, &it, &it + 1, true));
        }

        static void ForceId(List<MirrorField> fields)
        {
            var it = default(ForceId);
            fields.Add(new MirrorField("pbmpm_force_id", "index", &it, &it.Index, &it.Index + 1, false));
            fields.Add(new MirrorField("pbmpm_force_id", "generation", &it, &it.Generation, &it.Generation + 1, false));
            fields.Add(new MirrorField("pbmpm_force_id", "", &it, &it, &it + 1, false));
        }

        static void ForceDef(List<MirrorField> fields)
        {
            var it = default(ForceDef);
            fields.Add(new MirrorField("pbmpm_force_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "kind", &it, &it.Kind, &it.Kind + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "enabled", &it, &it.Enabled, &it.Enabled + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "everywhere", &it, &it.Everywhere, &it.Everywhere + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "falloff", &it, &it.Falloff, &it.Falloff + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "range", &it, &it.Range, &it.Range + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "strength", &it, &it.Strength, &it.Strength + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "direction", &it, &it.Direction, &it.Direction + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "velocity", &it, &it.Velocity, &it.Velocity + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "spin", &it, &it.Spin, &it.Spin + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "key", &it, &it.Key, &it.Key + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "user_data", &it, &it.UserData, &it.UserData + 1, false));
            fields.Add(new MirrorField("pbmpm_force_def", "", &it, &it, &it + 1, true));
        }

        static void ForceStatus(List<MirrorField> fields)
        {
            var it = default(ForceStatus);
            fields.Add(new MirrorField("pbmpm_force_status", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_force_status", "nodes", &it, &it.Nodes, &it.Nodes + 1, false));
            fields.Add(new MirrorField("pbmpm_force_status", "impulse", &it, &it.Impulse, &it.Impulse + 1, false));
            fields.Add(new MirrorField("pbmpm_force_status", "", &it, &it, &it + 1, true));
        }

        static void RegionShare(List<MirrorField> fields)
        {
            var it = default(RegionShare);
            fields.Add(new MirrorField("pbmpm_region_share", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "mass", &it, &it.Mass, &it.Mass + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "volume", &it, &it.Volume, &it.Volume + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "rest_volume", &it, &it.RestVolume, &it.RestVolume + 1, false));
            fields.Add(new MirrorField("pbmpm_region_share", "", &it, &it, &it + 1, true));
        }

        static void Ray(List<MirrorField> fields)
        {
            var it = default(Ray);
            fields.Add(new MirrorField("pbmpm_ray", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_ray", "level", &it, &it.Level, &it.Level + 1, false));
            fields.Add(new MirrorField("pbmpm_ray", "origin", &it, &it.Origin, &it.Origin + 1, false));
            fields.Add(new MirrorField("pbmpm_ray", "direction", &it, &it.Direction, &it.Direction + 1, false));
            fields.Add(new MirrorField("pbmpm_ray", "max_distance", &it, &it.MaxDistance, &it.MaxDistance + 1, false));
            fields.Add(new MirrorField("pbmpm_ray", "", &it, &it, &it + 1, true));
        }

        static void RayHit(List<MirrorField> fields)
        {
            var it = default(RayHit);
            fields.Add(new MirrorField("pbmpm_ray_hit", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "hit", &it, &it.Hit, &it.Hit + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "distance", &it, &it.Distance, &it.Distance + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "position", &it, &it.Position, &it.Position + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "normal", &it, &it.Normal, &it.Normal + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "material", &it, &it.Material, &it.Material + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "particle", &it, &it.Particle, &it.Particle + 1, false));
            fields.Add(new MirrorField("pbmpm_ray_hit", "", &it, &it, &it + 1, true));
        }

        static void MassProperties(List<MirrorField> fields)
        {
            var it = default(MassProperties);
            fields.Add(new MirrorField("pbmpm_mass_properties", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "volume", &it, &it.Volume, &it.Volume + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "mass", &it, &it.Mass, &it.Mass + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "centre", &it, &it.Centre, &it.Centre + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "inertia", &it, &it.Inertia, &it.Inertia + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "products", &it, &it.Products, &it.Products + 1, false));
            fields.Add(new MirrorField("pbmpm_mass_properties", "", &it, &it, &it + 1, true));
        }

        static void Submersion(List<MirrorField> fields)
        {
            var it = default(Submersion);
            fields.Add(new MirrorField("pbmpm_submersion", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "share", &it, &it.Share, &it.Share + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "volume", &it, &it.Volume, &it.Volume + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "centre", &it, &it.Centre, &it.Centre + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "density", &it, &it.Density, &it.Density + 1, false));
            fields.Add(new MirrorField("pbmpm_submersion", "", &it, &it, &it + 1, true));
        }

        static void RigidDef(List<MirrorField> fields)
        {
            var it = default(RigidDef);
            fields.Add(new MirrorField("pbmpm_rigid_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "stays_inside", &it, &it.StaysInside, &it.StaysInside + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "moves", &it, &it.Moves, &it.Moves + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "turns", &it, &it.Turns, &it.Turns + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "mass", &it, &it.Mass, &it.Mass + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "centre", &it, &it.Centre, &it.Centre + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "inertia", &it, &it.Inertia, &it.Inertia + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "products", &it, &it.Products, &it.Products + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "pivot", &it, &it.Pivot, &it.Pivot + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "move_axis", &it, &it.MoveAxis, &it.MoveAxis + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "turn_axis", &it, &it.TurnAxis, &it.TurnAxis + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "force", &it, &it.Force, &it.Force + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "torque", &it, &it.Torque, &it.Torque + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_def", "", &it, &it, &it + 1, true));
        }

        static void RigidState(List<MirrorField> fields)
        {
            var it = default(RigidState);
            fields.Add(new MirrorField("pbmpm_rigid_state", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "position", &it, &it.Position, &it.Position + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "rotation", &it, &it.Rotation, &it.Rotation + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "velocity", &it, &it.Velocity, &it.Velocity + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "angular_velocity", &it, &it.AngularVelocity, &it.AngularVelocity + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "velocity_change", &it, &it.VelocityChange, &it.VelocityChange + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "angular_velocity_change", &it, &it.AngularVelocityChange, &it.AngularVelocityChange + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "point", &it, &it.Point, &it.Point + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "virtual_mass", &it, &it.VirtualMass, &it.VirtualMass + 1, false));
            fields.Add(new MirrorField("pbmpm_rigid_state", "", &it, &it, &it + 1, true));
        }

        static void Stats(List<MirrorField> fields)
        {
            var it = default(Stats);
            fields.Add(new MirrorField("pbmpm_stats", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "particle_count", &it, &it.ParticleCount, &it.ParticleCount + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "step_count", &it, &it.StepCount, &it.StepCount + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "simulated_seconds", &it, &it.SimulatedSeconds, &it.SimulatedSeconds + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "memory_bytes", &it, &it.MemoryBytes, &it.MemoryBytes + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "particle_blocks", &it, &it.ParticleBlocks, &it.ParticleBlocks + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "node_blocks", &it, &it.NodeBlocks, &it.NodeBlocks + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "contacts", &it, &it.Contacts, &it.Contacts + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "substeps", &it, &it.Substeps, &it.Substeps + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "iterations", &it, &it.Iterations, &it.Iterations + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "thread_count", &it, &it.ThreadCount, &it.ThreadCount + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_total", &it, &it.MsTotal, &it.MsTotal + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_sort", &it, &it.MsSort, &it.MsSort + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_scatter", &it, &it.MsScatter, &it.MsScatter + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_contacts", &it, &it.MsContacts, &it.MsContacts + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_iterate", &it, &it.MsIterate, &it.MsIterate + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "ms_integrate", &it, &it.MsIntegrate, &it.MsIntegrate + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "volume_error_rms", &it, &it.VolumeErrorRms, &it.VolumeErrorRms + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "volume_error_max", &it, &it.VolumeErrorMax, &it.VolumeErrorMax + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "max_speed", &it, &it.MaxSpeed, &it.MaxSpeed + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "max_displacement", &it, &it.MaxDisplacement, &it.MaxDisplacement + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "mass", &it, &it.Mass, &it.Mass + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "momentum", &it, &it.Momentum, &it.Momentum + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "angular_momentum", &it, &it.AngularMomentum, &it.AngularMomentum + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "kinetic_energy", &it, &it.KineticEnergy, &it.KineticEnergy + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "potential_energy", &it, &it.PotentialEnergy, &it.PotentialEnergy + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "cell_changes", &it, &it.CellChanges, &it.CellChanges + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "lane_occupancy", &it, &it.LaneOccupancy, &it.LaneOccupancy + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "deleted_total", &it, &it.DeletedTotal, &it.DeletedTotal + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "clamped_total", &it, &it.ClampedTotal, &it.ClampedTotal + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "solver", &it, &it.Solver, &it.Solver + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "stop", &it, &it.Stop, &it.Stop + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "iterations_used", &it, &it.IterationsUsed, &it.IterationsUsed + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "residual", &it, &it.Residual, &it.Residual + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "predicted_error", &it, &it.PredictedError, &it.PredictedError + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "energy_checks_failed", &it, &it.EnergyChecksFailed, &it.EnergyChecksFailed + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "particles_asleep", &it, &it.ParticlesAsleep, &it.ParticlesAsleep + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "blocks_asleep", &it, &it.BlocksAsleep, &it.BlocksAsleep + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "blocks_drowsy", &it, &it.BlocksDrowsy, &it.BlocksDrowsy + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "blocks_woken", &it, &it.BlocksWoken, &it.BlocksWoken + 1, false));
            fields.Add(new MirrorField("pbmpm_stats", "", &it, &it, &it + 1, true));
        }

        static void Event(List<MirrorField> fields)
        {
            var it = default(Event);
            fields.Add(new MirrorField("pbmpm_event", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "kind", &it, &it.Kind, &it.Kind + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "count", &it, &it.Count, &it.Count + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "particle", &it, &it.Particle, &it.Particle + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "position", &it, &it.Position, &it.Position + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "substep", &it, &it.Substep, &it.Substep + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "step", &it, &it.Step, &it.Step + 1, false));
            fields.Add(new MirrorField("pbmpm_event", "", &it, &it, &it + 1, true));
        }

        static void SurfaceDef(List<MirrorField> fields)
        {
            var it = default(SurfaceDef);
            fields.Add(new MirrorField("pbmpm_surface_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "subdivision", &it, &it.Subdivision, &it.Subdivision + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "materials", &it, &it.Materials, &it.Materials + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "material_count", &it, &it.MaterialCount, &it.MaterialCount + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "level", &it, &it.Level, &it.Level + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "keeps_thin", &it, &it.KeepsThin, &it.KeepsThin + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "index_bytes", &it, &it.IndexBytes, &it.IndexBytes + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_def", "", &it, &it, &it + 1, true));
        }

        static void SurfaceMesh(List<MirrorField> fields)
        {
            var it = default(SurfaceMesh);
            fields.Add(new MirrorField("pbmpm_surface_mesh", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "stride", &it, &it.Stride, &it.Stride + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "positions", &it, &it.Positions, &it.Positions + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "normals", &it, &it.Normals, &it.Normals + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "velocities", &it, &it.Velocities, &it.Velocities + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "weights", &it, &it.Weights, &it.Weights + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "indices", &it, &it.Indices, &it.Indices + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "vertex_capacity", &it, &it.VertexCapacity, &it.VertexCapacity + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "index_capacity", &it, &it.IndexCapacity, &it.IndexCapacity + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "vertex_count", &it, &it.VertexCount, &it.VertexCount + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "index_count", &it, &it.IndexCount, &it.IndexCount + 1, false));
            fields.Add(new MirrorField("pbmpm_surface_mesh", "", &it, &it, &it + 1, true));
        }

        static void Point(List<MirrorField> fields)
        {
            var it = default(Point);
            fields.Add(new MirrorField("pbmpm_point", "position", &it, &it.Position, &it.Position + 1, false));
            fields.Add(new MirrorField("pbmpm_point", "radius", &it, &it.Radius, &it.Radius + 1, false));
            fields.Add(new MirrorField("pbmpm_point", "velocity", &it, &it.Velocity, &it.Velocity + 1, false));
            fields.Add(new MirrorField("pbmpm_point", "colour", &it, &it.Colour, &it.Colour + 1, false));
            fields.Add(new MirrorField("pbmpm_point", "", &it, &it, &it + 1, false));
        }

        static void PointsDef(List<MirrorField> fields)
        {
            var it = default(PointsDef);
            fields.Add(new MirrorField("pbmpm_points_def", "size", &it, &it.Size, &it.Size + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "material_count", &it, &it.MaterialCount, &it.MaterialCount + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "materials", &it, &it.Materials, &it.Materials + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "palette", &it, &it.Palette, &it.Palette + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "colour_from_user", &it, &it.ColourFromUser, &it.ColourFromUser + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "radius_scale", &it, &it.RadiusScale, &it.RadiusScale + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "spray_only", &it, &it.SprayOnly, &it.SprayOnly + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "reserved", &it, &it.Reserved, &it.Reserved + 1, false));
            fields.Add(new MirrorField("pbmpm_points_def", "", &it, &it, &it + 1, true));
        }
    }
}
