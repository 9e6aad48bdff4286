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
        /// <summary>grid values of one baked solid</summary>
        public const int MaxBakedNodes = 134217728;
        /// <summary>of a mesh to bake</summary>
        public const int MaxMeshVertices = 4194304;
        /// <summary>of points to wrap in a hull</summary>
        public const int MaxHullVertices = 262144;
        /// <summary>triangles or edges of a mesh to bake</summary>
        public const int MaxMeshElements = 4194304;
        /// <summary>samples of a height field</summary>
        public const int MaxHeights = 1048576;
        /// <summary>at the same time, per process</summary>
        public const int MaxWorlds = 1024;
        /// <summary>per world</summary>
        public const int MaxParticles = 268435456;
        /// <summary>per step</summary>
        public const int MaxSubsteps = 256;
        /// <summary>per substep</summary>
        public const int MaxIterations = 1000;
        /// <summary>Upper bound of pbmpm_settings.max_displacement [cells].</summary>
        public const int MaxCellsPerSubstep = 64;
        /// <summary>A particle farther than this from the origin along any axis [cells] is deleted, with an event.</summary>
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
        /// <summary>events that a world keeps until its next step</summary>
        public const int MaxEvents = 1024;
    }

    /// <summary>The result of a call. Zero is success. Any other left the world as it was before the call, unless the function says
    /// otherwise. Details: pbmpm_last_error().</summary>
    public enum Result : int
    {
        Ok = 0,
        /// <summary>null pointer, NaN, infinity, or a value outside its documented range</summary>
        ErrorInvalidArgument = 1,
        /// <summary>null, stale, foreign or made-up identifier</summary>
        ErrorInvalidId = 2,
        /// <summary>the allocator returned null, or the memory budget is used up</summary>
        ErrorOutOfMemory = 3,
        /// <summary>a limit is reached, or the caller's buffer is too small</summary>
        ErrorCapacity = 4,
        /// <summary>a conflicting call on this world by another thread, or a background step is not ended</summary>
        ErrorBusy = 5,
        /// <summary>the CPU has no SSE4.2</summary>
        ErrorUnsupportedCpu = 6,
        /// <summary>unknown structure size, material kind or format; or not in this build or this world</summary>
        ErrorUnsupported = 7,
        /// <summary>a worker thread could not be started</summary>
        ErrorThread = 8,
        /// <summary>still in use: a material by particles or emitters, a baked solid by colliders</summary>
        ErrorInUse = 9,
        /// <summary>the world belongs to the parent process; in the child only destroy works</summary>
        ErrorForked = 10,
        /// <summary>stored data is truncated or changed, or was never the library's</summary>
        ErrorDamaged = 11,
        /// <summary>a snapshot of another format version, or of a world whose definition, materials or
        /// objects differ from this one's</summary>
        ErrorForeign = 12,
    }

    /// <summary>How severe a line of the log is.</summary>
    public enum LogLevel : int
    {
        /// <summary>a call was refused or failed</summary>
        Error = 1,
        /// <summary>a step went on, but not as asked: particles were deleted</summary>
        Warning = 2,
        /// <summary>a world was created: its grid, kernels and threads</summary>
        Info = 3,
    }

    /// <summary>Instruction sets of the kernels. On x86, PBMPM_ISA=sse4|avx2|avx512 in the environment lowers the choice, and never raises
    /// it. The library reads it at the first call that needs it. ARM and WebAssembly have one set each.</summary>
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
        /// <summary>resists compression, and shear up to its friction; bears tension only with `cohesion`</summary>
        Sand = 2,
        /// <summary>elastic until strained too far, then flows at constant volume: clay, dough, mud</summary>
        Visco = 3,
    }

    /// <summary>What happens to an elastic particle that is strained too far.</summary>
    public enum StrainPolicy : int
    {
        /// <summary>singular values of F are kept in [strain_min, strain_max]</summary>
        Clamp = 0,
        /// <summary>deleted, with an event, if the condition number of F exceeds condition_max (the paper's rule).
        /// Also if det F is 0 or less, or a stretch reaches 10,000</summary>
        Delete = 1,
    }

    /// <summary>How the stress of an elastic body follows from F. Here mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)). Only
    /// with the primal and the explicit solver. The paper's solver has no such law, and the dual takes every body as fixed
    /// corotated.</summary>
    public enum ElasticModel : int
    {
        /// <summary>energy mu |F - R|^2 + lambda/2 (J - 1)^2, R the rotation of F</summary>
        FixedCorotated = 0,
        /// <summary>energy mu/2 (|F|^2 - d) - mu ln J + lambda/2 (ln J)^2. Below J = 0.1 ln J is continued by its
        /// second-order expansion, so that inverted matter has a finite stress</summary>
        NeoHookean = 1,
    }

    /// <summary>The kind of a shape. Members of pbmpm_shape that a kind does not name are ignored.</summary>
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
        /// <summary>solid of any form, see solid.h; not for emitters, drains and forces (INVALID_ARGUMENT)</summary>
        Baked = 4,
    }

    /// <summary>How the equations of a substep are solved.</summary>
    public enum Solver : int
    {
        /// <summary>the published method: N rounds of projection. Stiffness depends on N and dt, not on moduli</summary>
        Paper = 0,
        /// <summary>backward Euler with the materials' moduli; solves for one stress per particle. For liquids,
        /// sand, and bodies in liquids. Accelerated proximal gradients (FISTA) with restart</summary>
        Dual = 1,
        /// <summary>the same equations; solves for the displacements of grid nodes. For elastic bodies; none gains
        /// energy. L-BFGS with a multilevel preconditioner. Leave bulk_modulus of liquids at 0 with it:
        /// stiff liquids hardly move</summary>
        Primal = 2,
        /// <summary>explicit MLS-MPM, to compare with: one pass, stable only while sound travels less than a cell
        /// per substep. Every liquid needs a bulk_modulus above 0, else steps return INVALID_ARGUMENT</summary>
        Explicit = 3,
        /// <summary>default: per island of touching matter the dual, the primal or both, see docs/method.md</summary>
        Convergent = 4,
    }

    /// <summary>Where the dual solver keeps the pressure of a liquid.</summary>
    public enum Pressure : int
    {
        /// <summary>calm pools: each particle keeps its volume. More iterations damp fine motion more</summary>
        Particles = 0,
        /// <summary>lively: each cell keeps the volume of its particles. Costs more, and pools stay restless.
        /// With PBMPM_SOLVER_CONVERGENT, liquid that touches solids uses PARTICLES all the same</summary>
        Cells = 1,
    }

    /// <summary>The time integration scheme.</summary>
    public enum Integrator : int
    {
        /// <summary>backward Euler: first order in dt, damps rotation and oscillation</summary>
        Euler = 0,
        /// <summary>second order: hardly damps them. Only where the primal solves without the dual, else EULER</summary>
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
        /// <summary>1 float: J, present volume over rest volume. Liquids: in [0.05, 1.2]. Elastic: det F after the
        /// last step. Sand with the dual or convergent solver: kept apart from F</summary>
        VolumeRatio = 3,
        /// <summary>d*d floats, row-major F; identity for liquids. Exists once the world had a particle that is not
        /// liquid. Sand with the dual or convergent solver: encodes stress and is no strain; det F =
        /// exp(-pressure / K), K = lambda + 2 mu / d</summary>
        Deformation = 4,
        /// <summary>1 uint32: index of the material's identifier</summary>
        Material = 5,
        /// <summary>2 uint32: pbmpm_particle_id</summary>
        Particle = 6,
        /// <summary>1 float [kg] (2D: per metre of depth); read-only</summary>
        Mass = 7,
        /// <summary>1 float [Pa] (2D: N/m): last pressure of liquid, or of sand with the dual or convergent solver;
        /// else 0. Exists once a step needed it, or it was set. Liquid: divide it by J for the true
        /// pressure; with a bulk modulus K that is K (1 - J). Values of neighbours scatter, which moves
        /// nothing: average them.</summary>
        Pressure = 8,
        /// <summary>1 uint32: the host's own, which goes with the particle (a colour, an owner); default 0. Exists,
        /// and takes memory, once a value other than 0 was given, or any was set.</summary>
        UserValue = 9,
    }

    /// <summary>What an obstacle does to motion along its surface.</summary>
    public enum Friction : int
    {
        /// <summary>solids: tangential impulse of at most friction_coefficient times the normal impulse. Liquid
        /// ignores the coefficient: it sticks if kinematic_viscosity is above 0, else slips. With the
        /// paper's and the primal solver liquid always slips</summary>
        Coulomb = 0,
        /// <summary>matter moves with the surface and cannot leave it; liquid, too</summary>
        Stick = 1,
        /// <summary>no tangential impulse, not even on viscous liquid</summary>
        Slip = 2,
    }

    /// <summary>What became of a touch since the last call of pbmpm_world_touches().</summary>
    public enum TouchState : int
    {
        /// <summary>it is new</summary>
        Began = 1,
        /// <summary>it was there before</summary>
        Stays = 2,
        /// <summary>it is over</summary>
        Ended = 3,
    }

    /// <summary>What an advice is about. "Figure" is pbmpm_advice.figure, "bound" is pbmpm_advice.bound. [cells]: lengths over the cell size.
    /// dt: the length of a substep, dx: the cell size.</summary>
    public enum AdviceCode : int
    {
        /// <summary>settings.gravity is 0, and no uniform force acts</summary>
        NoGravity = 1,
        /// <summary>matter or an emitter has nothing below it along gravity, and no kill bounds take the
        /// matter. Or, before the first step, part of it lies where only the kill bounds take it.
        /// Figure: share</summary>
        FallsForever = 2,
        /// <summary>a changed parameter has no effect here; the text names it. Figure: it; bound: its
        /// default</summary>
        Ignored = 3,
        /// <summary>a liquid is compressed by its weight. Figure: g dt^2 depth / dx^2, depth in metres;
        /// paper's solver: the strain at the bottom</summary>
        PoolTooDeep = 4,
        /// <summary>a pool keeps moving. Figure: its rms speed [m/s]. Foreseen (dual solver): within a
        /// factor of three. Came true: measured from five seconds after the first step on, where
        /// nothing drives the liquid; not if it may be a wave of half a cell or more</summary>
        PoolStirs = 5,
        /// <summary>the iterations are too few for the material's modulus. Figure: the Young modulus [Pa]
        /// that acts; bound: its own</summary>
        ModulusNotHeld = 6,
        /// <summary>sand is crushed, lies too flat, or runs too fast or slowly; the text tells which.
        /// Crushed by its weight: figure g dt^2 depth / dx^2 (dual solver, or beside liquid), else
        /// its mean strain. Landing, sliding or running: figure its speed [cells per substep]</summary>
        SandNotHeld = 7,
        /// <summary>a body is too thin for the grid. Figure: its thickness [cells]</summary>
        BodyTooThin = 8,
        /// <summary>a contact is too short for the time step, so a body bounces too little. Figure: substeps
        /// that the contact of an equally thick ball lasts (Hertz's theory)</summary>
        BounceDamped = 9,
        /// <summary>a round body rolls too slowly. Figure: half of its contact's width (Hertz) [cells]</summary>
        RollingBraked = 10,
        /// <summary>an obstacle skips past matter. Figure: its way in the next substep [cells]</summary>
        ColliderTooFast = 11,
        /// <summary>an obstacle is so thin that its two sides feel each other. Figure: thickness
        /// [cells]</summary>
        ColliderTooThin = 12,
        /// <summary>matter is too fast for settings.max_displacement, or liquid and bodies enter each other
        /// where they meet. Figure: its speed, or that at which they meet [cells per substep]</summary>
        StepTooLong = 13,
        /// <summary>before the first step: matter was put where other matter is. Figure: share of the
        /// material that lies in overfull places; for liquids, of all liquids together</summary>
        Overlaps = 17,
        /// <summary>what the library does not do right; the text says what, and what helps. No figure</summary>
        KnownLimit = 18,
        /// <summary>sand, viscous liquid or a rigid body rests on walls without friction. Figure: sand: the
        /// Coulomb coefficient of the domain's floor; else 0</summary>
        NoFriction = 19,
        /// <summary>an emitter is wholly outside the domain, so it emits nothing. Figure: how far [cells]</summary>
        EmitterOutside = 20,
        /// <summary>came true: an emitter found its place full, so it gave less than its rate. Figure: the
        /// share that was refused so far</summary>
        EmitterRefused = 21,
        /// <summary>a baked obstacle's grid is too coarse at an edge where liquid or sand gets. Only
        /// edges of its bounding box are looked at. Figure: the width of its grid's cells
        /// [cells of the world]</summary>
        ColliderTooCoarse = 22,
        /// <summary>matter takes less room than its rest volume. Figure: the share that is lost at least
        /// (measured less two standard errors)</summary>
        VolumeLost = 14,
        /// <summary>a solid is strained to a bound of its material. Figure: share of its particles</summary>
        StrainClamped = 15,
        /// <summary>the last substep did not converge. Figure [cells]: predicted rms error, at most rms
        /// motion</summary>
        NotSolved = 16,
    }

    /// <summary>What would help.</summary>
    public enum Change : int
    {
        /// <summary>no setting helps for less than eight times the step time; see the text. `value`, `price`: 0</summary>
        None = 0,
        /// <summary>settings.substeps, or the rate (steps per second) in the same proportion</summary>
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
        /// <summary>more resolution of the obstacle's baked grid; the value is its baked_info.spacing [m]</summary>
        BakedSpacing = 11,
    }

    /// <summary>What lines can show. Add values to choose several.</summary>
    public enum DebugPart : int
    {
        /// <summary>the outlines of the closed walls; open ones are not drawn</summary>
        Domain = 1,
        /// <summary>where they stand now</summary>
        Colliders = 2,
        /// <summary>where they stand now, those that are switched off too</summary>
        Emitters = 4,
        /// <summary>where they stand now, those that are switched off too</summary>
        Drains = 8,
        /// <summary>where those stand that are switched on</summary>
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
        /// <summary>on the disc of the shape's `radius` around its `position`, perpendicular to `direction` (2D: on that
        /// line); the kind of the shape does not matter</summary>
        Disc = 1,
    }

    /// <summary>What a force does. c: the shape's position; r = x - c; s: the share that is felt at x, see pbmpm_falloff; dx: the cell size.
    /// Nearer than dx to the centre or the axis, RADIAL and VORTEX fall to 0.</summary>
    public enum ForceKind : int
    {
        /// <summary>acceleration strength * s along `direction`</summary>
        Uniform = 0,
        /// <summary>acceleration strength * s * r / max(|r|, dx): pushes away, or pulls when negative</summary>
        Radial = 1,
        /// <summary>acceleration strength * s * (n cross r) / max(|n cross r|, dx) about the axis n = `direction`
        /// through c; 2D: n points along the third axis: counter-clockwise</summary>
        Vortex = 2,
        /// <summary>acceleration -k (v - w) with k = strength * s and w = velocity + spin * (n cross r): wind, a
        /// whirl, or, with w = 0, a brake. Negative strengths are refused.</summary>
        Drag = 3,
        /// <summary>drags matter to the velocity w (as DRAG) with k = -60 ln(1 - s) [1/s]. Where s = 1 matter has
        /// exactly w, except within a cell of obstacles. Its force has no bound; DRAG has one</summary>
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
        /// <summary>(1 + d / range)^-2 at any distance; around a ball of radius `range`: its gravity</summary>
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

    /// <summary>Flags of pbmpm_snapshot_restore().</summary>
    public enum RestoreFlags : int
    {
        /// <summary>for saves from before a game update: the world keeps its own parameters</summary>
        RestoreKeepParameters = 1,
    }

    /// <summary>What an event tells.</summary>
    public enum EventKind : int
    {
        /// <summary>a particle's state was NaN or infinite; it was taken out before it touched others</summary>
        DeletedNotFinite = 1,
        /// <summary>a particle went beyond PBMPM_MAX_CELL</summary>
        DeletedOutOfRange = 2,
        /// <summary>a particle was strained too far, see PBMPM_STRAIN_DELETE</summary>
        DeletedCondition = 3,
        /// <summary>particles were slowed to max_displacement; count: how many; with one of them</summary>
        SpeedClamped = 4,
        /// <summary>a call asked for more particles than fit; count: for how many; without one</summary>
        Capacity = 5,
        /// <summary>an emitter had no space, no budget or no room for particles that were due; count: how
        /// many; without one, at the emitter's position</summary>
        EmissionRefused = 6,
        /// <summary>particles left the kill bounds; count: how many; with the first of them</summary>
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

    /// <summary>A world. Identifiers are a slot (`index`) and a number that tells its owners apart (`generation`). All zero means "none". The
    /// identifier of a destroyed object is never valid again (short of 2^32 objects in a process). One of another world is refused,
    /// too.</summary>
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

    /// <summary>A particle of one world, for as long as the particle lives.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ParticleId
    {
        public uint Index;
        public uint Generation;
    }

    /// <summary>Parameters of one material. Fill it with pbmpm_material_def_init(), then change what differs. What solvers do with them:
    /// docs/method.md, "Matter".
    ///
    /// Members marked "elastic" count for sand and visco, too, except elastic_model. Sand and visco need an elasticity_ratio of at
    /// least 0.01, else INVALID_ARGUMENT.
    ///
    /// With the paper's solver stiffness is no parameter: it follows from the rate. A liquid acts with the bulk modulus
    /// density * relaxation * N * dx^2 / (4 d dt^2). An elastic body acts with the Young modulus
    /// density * relaxation * N * dx^2 / (4 dt^2). The other solvers take bulk_modulus, elastic_model, young_modulus and
    /// poisson_ratio. All solvers take kinematic_viscosity.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct MaterialDef
    {
        /// <summary>sizeof(pbmpm_material_def), set by pbmpm_material_def_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_LIQUID; cannot be changed later</summary>
        public MaterialKind Kind;
        /// <summary>rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6]; default 1000</summary>
        public float Density;
        /// <summary>paper's and dual solver: share of the error removed per iteration, in (0, 2); default 1.5. With
        /// `iterations` 1 use at most 4/3, else lone elastic particles tremble.</summary>
        public float Relaxation;
        /// <summary>liquid, paper's solver only: share of the deviatoric strain rate removed per iteration,
        /// in [0, 1]; default 0. Acts as a kinematic viscosity of N * viscosity * dx^2 / (8 dt).</summary>
        public float Viscosity;
        /// <summary>liquid, visco, and sand with the dual: how fast J is corrected to the volume on the grid,
        /// in [0, 1]; default 0.1; 0: off, and torn visco keeps its gaps. Share per 1/60 s, or per substep
        /// if longer; paper's solver, liquid: per substep. docs/method.md: Liquids keep their volume</summary>
        public float VolumeFeedback;
        /// <summary>elastic, paper's solver only: in [0, 1]; default 1. 1 resists any change of shape, 0 only
        /// changes of volume; values between blend the two</summary>
        public float ElasticityRatio;
        /// <summary>elastic; default PBMPM_STRAIN_CLAMP</summary>
        public StrainPolicy StrainPolicy;
        /// <summary>elastic: lower bound of the singular values of F, in [1e-3, 1]; default 0.1</summary>
        public float StrainMin;
        /// <summary>elastic: upper bound, in [1, 1e4]; default 20</summary>
        public float StrainMax;
        /// <summary>elastic, PBMPM_STRAIN_DELETE: largest condition number of F, in [10, 1e6]; default 1e6</summary>
        public float ConditionMax;
        /// <summary>elastic, paper's solver only: largest strain corrected per iteration, in (0, 10]; default 1.
        /// Matter that was crushed to nothing grows back at this rate instead of exploding.</summary>
        public float ReboundMax;
        /// <summary>liquid, not the paper's solver: K [Pa] (2D: N/m) of the pressure K (1 - J), in [1e-3, 1e15], or
        /// 0 (default): incompressible</summary>
        public float BulkModulus;
        /// <summary>liquid: nu [m^2/s], in [0, 1e6]; default 0; honey has 0.005. Above 0 it sticks to walls and
        /// obstacles, see pbmpm_friction, not to rigid bodies (rigid.h). Paper's solver: acts like 8 nu dt
        /// / (N dx^2) more `viscosity`; the sum is capped at 1.</summary>
        public float KinematicViscosity;
        /// <summary>elastic, only with the primal and the explicit solver; default PBMPM_FIXED_COROTATED</summary>
        public ElasticModel ElasticModel;
        /// <summary>elastic, not the paper's solver: E [Pa] (2D: plane strain), in [1e-3, 1e15]; default 1e5</summary>
        public float YoungModulus;
        /// <summary>elastic, not the paper's solver: nu, in [0, 0.495]; default 0.3</summary>
        public float PoissonRatio;
        /// <summary>sand: phi [rad], in [0, 1.4]; default pi/6; tan(phi) is the friction coefficient. Law of Mohr
        /// and Coulomb in 2D and 3D: shear stress is at most sin(phi) times the mean of the largest and
        /// smallest principal pressure.</summary>
        public float FrictionAngle;
        /// <summary>sand: bears tension until it has grown to J = exp(cohesion), in [0, 0.5]; default 0: dry</summary>
        public float Cohesion;
        /// <summary>sand: 1 (default): loosened sand regains its volume before it bears pressure, from up to 3
        /// times of it (dual: 1.15). 0: it stays loose, and a heap grows with each fall</summary>
        public uint VolumeCorrection;
        /// <summary>visco: largest norm of the deviator of the logarithmic strain (ln of the stretches) that it
        /// bears, in [0, 10]; default 0.05. The yield stress in shear is sqrt(2) mu yield_strain.</summary>
        public float YieldStrain;
        /// <summary>visco [1/s]: strain beyond yield_strain shrinks by exp(-flow_rate dt) per substep, in [0, 1e9];
        /// default 100. If flow_rate dt is far below 1: a Bingham fluid of viscosity mu / flow_rate
        /// [Pa s]. The default at 60 Hz gives 1.7, so flow depends on dt.</summary>
        public float FlowRate;
        /// <summary>unique number among the world's materials, by which snapshots match it; 0 (default): matched by the
        /// index of its identifier instead, see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>bit set of the groups that it belongs to, see pbmpm_collider_def.meets; must not be 0; default 1. Walls
        /// of the domain act on all.</summary>
        public uint Groups;
        /// <summary>must be 0</summary>
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

    /// <summary>How stiff a material is with a world's settings and time step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Effective
    {
        /// <summary>sizeof(pbmpm_effective), set by the caller</summary>
        public uint Size;
        /// <summary>[Pa]; 0: incompressible. Paper's solver: liquid density * relaxation * N * dx^2 / (4 d dt^2); elastic
        /// a third (2D: half) of young_modulus. Other solvers, elastic: lambda + 2 mu / d of the young_modulus
        /// below. Other solvers, liquid: the material's own. Primal: what it used in the last step, if the
        /// liquid is incompressible or CONVERGENT bounds it.</summary>
        public float BulkModulus;
        /// <summary>elastic [Pa]; 0 for a liquid. Paper's solver: density * relaxation * N * dx^2 / (4 dt^2). Primal and
        /// explicit: the material's own. Dual: that, or what N iterations reach if that is less. Convergent: as
        /// the solver of the island that the particles are in now; of several islands the softest.</summary>
        public float YoungModulus;
        /// <summary>liquid [m^2/s]: the material's own. Paper's solver: plus N viscosity dx^2 / (8 dt), capped at
        /// N dx^2 / (8 dt). Numerical viscosity is not included</summary>
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
        /// <summary>grid values per axis</summary>
        public Uint3 Count;
        /// <summary>[m] width of a grid cell. Distances err by under half of it; midway between parts of the surface by up
        /// to 0.87 of it (2D: 0.71).</summary>
        public float Spacing;
        /// <summary>lower corner of the grid [m], in the mesh's coordinates</summary>
        public Float3 Minimum;
        /// <summary>upper corner; the surface lies two cells inside</summary>
        public Float3 Maximum;
        /// <summary>size of the baked data, in a file and in a world</summary>
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
        /// <summary>centre, or a point of the plane, each in [-1e9, 1e9]; default 0</summary>
        public Float3 Position;
        /// <summary>unit quaternion (x, y, z, w); normalised by the library, length in [0.5, 2]; default (0, 0, 0, 1).
        /// 2D: a turn by the angle a is (0, 0, sin(a/2), cos(a/2)); x and y must be 0.</summary>
        public Float4 Rotation;
        /// <summary>box: each in [1e-9, 1e9]; capsule: [0] in [0, 1e9]; default 0.5</summary>
        public Float3 HalfExtents;
        /// <summary>sphere, capsule: in [1e-9, 1e9]; default 0.5</summary>
        public float Radius;
        /// <summary>plane: outward direction before rotation, any length &gt; 1e-6; default (0, 1, 0)</summary>
        public Float3 Normal;
        /// <summary>baked: the solid, of the same world; `position` is where its mesh's origin stands; default null</summary>
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

    /// <summary>What a world keeps all its life. Fill it with pbmpm_world_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct WorldDef
    {
        /// <summary>sizeof(pbmpm_world_def), set by pbmpm_world_def_init()</summary>
        public uint Size;
        /// <summary>2 or 3; default 3. 2D: positions and velocities use components 0 and 1, spins component 2.</summary>
        public int Dimension;
        /// <summary>grid spacing dx [m], in [1e-6, 1e6]; default 0.1</summary>
        public float CellSize;
        /// <summary>hard limit, 1 to PBMPM_MAX_PARTICLES; default 65536. Taken at creation: some 230 bytes per
        /// particle in 3D, and 0.12 MB of tables. More is taken later for fields that a solver needs, for
        /// colliders, and for occupied blocks (4^d cells).</summary>
        public uint ParticleCapacity;
        /// <summary>place of the world in the host's coordinates [m]; default 0. A place is origin + position; the
        /// host adds them. The library computes without it, so scenes far from zero lose no precision.
        /// pbmpm_world_shift_origin() moves it.</summary>
        public Double3 Origin;
        /// <summary>bytes that the world may hold at once; 0 (default): no limit</summary>
        public ulong MemoryBudget;
        /// <summary>1 to 256, counting the caller; 0 (default): one per core of the machine. Results do not depend
        /// on it. With task hooks: how many tasks each enqueue gets; 0: one per core.</summary>
        public int ThreadCount;
        /// <summary>1: a closed box; pbmpm_domain_wall_set() opens walls. 0 (default): unbounded; what falls costs
        /// time for ever, unless kill bounds (drain.h) take it out</summary>
        public int DomainEnabled;
        /// <summary>lower corner of the box [m], relative to the origin, within 2^21 cells of it; default 0</summary>
        public Float3 DomainMin;
        /// <summary>upper corner, within 2^21 cells, too; at least 4 cells above domain_min per axis; default 1</summary>
        public Float3 DomainMax;
        /// <summary>Coulomb coefficient of the walls, in [0, 100]; default 0; see pbmpm_friction</summary>
        public float DomainFriction;
        /// <summary>1: pbmpm_domain_impulse() reads what matter does to the walls; 0 (default): off</summary>
        public int DomainMeasuresImpulse;
        /// <summary>null (default): the C library's memory. Copied at creation.</summary>
        public IntPtr Allocator;
        /// <summary>null (default): the world's own threads. Copied at creation.</summary>
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

    /// <summary>What may change between steps. State is in SI units, so dt and settings may change between any two steps.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Settings
    {
        /// <summary>sizeof(pbmpm_settings), set by pbmpm_settings_init()</summary>
        public uint Size;
        /// <summary>equal parts that a step is cut into, 1 to PBMPM_MAX_SUBSTEPS; default 1</summary>
        public int Substeps;
        /// <summary>N: of the solver, per substep, 1 to PBMPM_MAX_ITERATIONS; default 5. Ignored by
        /// PBMPM_SOLVER_EXPLICIT.</summary>
        public int Iterations;
        /// <summary>acceleration [m/s^2], each in [-1e9, 1e9]; default 0</summary>
        public Float3 Gravity;
        /// <summary>largest particle displacement per substep [cells], in [0.1, PBMPM_MAX_CELLS_PER_SUBSTEP]; default
        /// 32. Faster particles are slowed to it. An event and pbmpm_stats.clamped_total count them.</summary>
        public float MaxDisplacement;
        /// <summary>default PBMPM_SOLVER_CONVERGENT</summary>
        public Solver Solver;
        /// <summary>for liquids that the dual solves, also within CONVERGENT; default PBMPM_PRESSURE_PARTICLES</summary>
        public Pressure Pressure;
        /// <summary>default PBMPM_INTEGRATOR_EULER</summary>
        public Integrator Integrator;
        /// <summary>share of the motion finer than the grid that liquids keep, in [0, 1]; default 0; 0.9 is lively. No
        /// effect on viscous liquids and with the paper's solver. (ASFLIP: Fei, Guo, Wu, Huang, Gao 2021)</summary>
        public float Flip;
        /// <summary>dual and primal, also within CONVERGENT: iterations end when the predicted error of the solution
        /// [cells] is below this, in [0, 1]; 0 (default): off</summary>
        public float TargetError;
        /// <summary>as above: wall time for a step [ms], in [0, 1e6]; 0 (default): off. Of n substeps, substep k begins
        /// no iteration after k / n of it. Results then depend on the machine's speed: not deterministic.</summary>
        public float TimeBudgetMs;
        /// <summary>1: blocks of matter at rest sleep and cost nothing until something wakes them, see sleep.h. 0
        /// (default): off, costs nothing</summary>
        public int Sleeping;
        /// <summary>a block rests below this rms speed of its particles [m/s], in [0, 1e9]; default 0.05</summary>
        public float SleepSpeed;
        /// <summary>how long a block and its neighbours must rest before it sleeps [s], in [0, 1e6]; default 0.5</summary>
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
        /// <summary>of the particles</summary>
        public MaterialId Material;
        /// <summary>lattice points per cell and axis, in [0.25, 16]; default 2 (4 per cell in 2D, 8 in 3D)</summary>
        public float ParticlesPerAxis;
        /// <summary>random offset per axis, up to +- jitter / 2 lattice spacings, in [0, 1]; default 0.5</summary>
        public float Jitter;
        /// <summary>of every particle [m/s], each in [-1e9, 1e9]; default 0</summary>
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
        /// <summary>acts on materials whose `groups` share a bit with it; 0 (default): on all. Others pass through
        /// it, slowed within 2.5 cells of matter that is held, see docs/limits.md. Fills, emitters,
        /// touches and pbmpm_collider_submerged() respect it; queries do not.</summary>
        public uint Meets;
        /// <summary>unique number among the world's colliders, by which snapshots match it; 0 (default): matched by the
        /// index of its identifier instead, see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>1: a trigger that matter passes through; measures_impulse must be 0. 0 (default): an obstacle</summary>
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

    /// <summary>What matter gave to an obstacle in a step: the momentum that matter lost to it. A host that moves a rigid body itself adds it
    /// to the body's momentum; pbmpm_rigid_advance() does that, see rigid.h. The sum over all obstacles and walls is what matter
    /// lost, apart from gravity, forces, and deleted or slowed particles. In 2D per metre of depth.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Impulse
    {
        /// <summary>sizeof(pbmpm_impulse), set by the caller</summary>
        public uint Size;
        /// <summary>[N s]</summary>
        public Double3 Linear;
        /// <summary>[N m s] about the obstacle's position after the step; walls: about the origin. 2D: only component 2</summary>
        public Double3 Angular;
    }

    /// <summary>A wall of the domain. Read it with pbmpm_domain_wall_get(), change what differs, and give it to pbmpm_domain_wall_set().</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct DomainWall
    {
        /// <summary>sizeof(pbmpm_domain_wall), set by the caller</summary>
        public uint Size;
        /// <summary>1: there is no wall. 0 (default): holds matter in. Walls are infinite planes, so a floor goes
        /// on outside. Matter that leaves never comes back by itself: set kill bounds (drain.h).</summary>
        public int Open;
        /// <summary>default PBMPM_FRICTION_COULOMB</summary>
        public Friction Friction;
        /// <summary>Coulomb coefficient, in [0, 100]; default world_def.domain_friction</summary>
        public float FrictionCoefficient;
    }

    /// <summary>One material that touches one collider.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Touch
    {
        /// <summary>sizeof(pbmpm_touch); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>compared with the last call</summary>
        public TouchState State;
        /// <summary>what is touched</summary>
        public ColliderId Collider;
        /// <summary>what touches it; null if it was destroyed since</summary>
        public MaterialId Material;
        /// <summary>how many touch it now; 0 if the touch ended</summary>
        public uint Particles;
        /// <summary>0</summary>
        public uint Reserved;
        /// <summary>of all matter on the collider in the last step [N s], see pbmpm_collider_impulse(); or 0</summary>
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

    /// <summary>A shape that takes out the particles inside it. It looks at the end of each substep: a particle that crosses a thin drain
    /// within a substep is not seen. A particle inside several drains is counted by the one with the lowest identifier index.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct DrainDef
    {
        /// <summary>sizeof(pbmpm_drain_def), set by pbmpm_drain_def_init()</summary>
        public uint Size;
        /// <summary>1 (default): takes; 0: rests</summary>
        public int Enabled;
        /// <summary>the material it takes, none once that is destroyed; all zero (default): every one</summary>
        public MaterialId Material;
        /// <summary>unique number among the world's drains, by which snapshots match it; 0 (default): matched by the index
        /// of its identifier instead, see snapshot.h</summary>
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

    /// <summary>The box that particles live in. Those outside at the end of a substep are taken out, with one PBMPM_EVENT_KILLED per substep.
    /// Unlike the domain it has no walls. Without bounds, matter that falls for ever goes on using particle_capacity and time.</summary>
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

    /// <summary>Totals since the world was created, including those of destroyed emitters and drains.
    /// Particles now = those added by calls - those removed by calls + emitted - drained - killed - pbmpm_stats.deleted_total.</summary>
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
    /// (i + 1/2) V / rate after the emitter began. So after a time T, T rate / V +- 1/2 particles were due, whatever the substeps. A
    /// particle appears at the end of the substep in which it is due. By then it has moved and fallen as if born when it was due, so
    /// the stream has no pulses. If an obstacle that acts on it is in the way it appears where it was born.
    /// Places follow a sequence that fills the region evenly.
    ///
    /// A particle that is due is refused
    /// - when the matter at its place fills more than `fill_limit`;
    /// - when it is solid and only the matter around it is this dense, empty space aside: solids that are born too dense stay so;
    /// - when obstacles enclose the space, and all matter in there would fill more than `fill_limit` of it. The emitter looks for
    /// such a space up to about four cells away;
    /// - when an obstacle or the outside of the domain is there;
    /// - when the budget is spent or the world has no room.
    /// Refused particles are lost. pbmpm_emitter_status counts them, and each emitter tells them by one PBMPM_EVENT_EMISSION_REFUSED
    /// per substep.</summary>
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
        /// <summary>rest volume per second, not particles [m^3/s] (2D: [m^2/s]), in [0, 1e12]; default 0. A full
        /// stream needs A * speed, A the area of the region seen along `direction`. Where gravity or
        /// pressure carries matter off faster, more gets out.</summary>
        public float Rate;
        /// <summary>of the particles [m/s], in [0, 1e6]; default 0</summary>
        public float Speed;
        /// <summary>of the velocity, in the shape's own frame, any length &gt; 1e-6; default (0, -1, 0)</summary>
        public Float3 Direction;
        /// <summary>largest angle between a particle's velocity and `direction` [rad], in [0, pi], evenly spread
        /// over the cone; default 0</summary>
        public float Spread;
        /// <summary>size of the particles: so many per cell and axis, in [0.25, 16]; default 2</summary>
        public float ParticlesPerAxis;
        /// <summary>nothing is emitted where matter fills more than this share of the open space, in [0.1, 100];
        /// default 1. Inside a pool set more than 1.1, which resting liquid measures; with the paper's
        /// solver more than 1.2, which it measures at depth.</summary>
        public float FillLimit;
        /// <summary>particles that it may emit in its life; 0 (default): no limit</summary>
        public ulong Budget;
        /// <summary>unique number among the world's emitters, by which snapshots match it; 0 (default): matched by the
        /// index of its identifier instead, see snapshot.h</summary>
        public ulong Key;
        /// <summary>the host's own; the library only keeps it; default 0</summary>
        public ulong UserData;
        /// <summary>of its particles, see PBMPM_USER_VALUE; default 0</summary>
        public uint UserValue;
        /// <summary>must be 0</summary>
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
        /// <summary>[kg] (2D: per metre of depth)</summary>
        public double EmittedMass;
        /// <summary>particles for which there was no space: matter, an obstacle, or the outside of the domain</summary>
        public ulong RefusedFull;
        /// <summary>those due after the budget was spent</summary>
        public ulong RefusedBudget;
        /// <summary>those due while the world was full</summary>
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
    /// Forces act on grid nodes at the start of each substep, before materials and obstacles. Nodes that a GRAB holds with s = 1 also
    /// keep their velocity while materials act. Blocks (4^d cells) that no force reaches cost nothing.
    /// Let v be a node's velocity as its particles give it. a is the sum of gravity and all accelerations. k is the sum of all drag
    /// coefficients, and w the mean of their velocities w, weighted by k. The velocity becomes the exact solution of v' = a - k (v - w)
    /// after the substep dt:
    /// v exp(-k dt) + w (1 - exp(-k dt)) + a (1 - exp(-k dt)) / k       (k = 0: v + a dt)
    /// So drag is stable for any k and dt, and falling matter ends at exactly w + a / k. The order of forces does not matter. The
    /// impulse of each force is what it adds to the momentum of the nodes, see pbmpm_force_status.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct ForceDef
    {
        /// <summary>sizeof(pbmpm_force_def), set by pbmpm_force_def_init()</summary>
        public uint Size;
        /// <summary>default PBMPM_FORCE_UNIFORM</summary>
        public ForceKind Kind;
        /// <summary>1 (default): acts; 0: rests</summary>
        public int Enabled;
        /// <summary>1 (default): s = 1 everywhere; of the shape only the centre counts. 0: s by shape and falloff.</summary>
        public int Everywhere;
        /// <summary>default PBMPM_FALLOFF_NONE</summary>
        public Falloff Falloff;
        /// <summary>of the falloff [m], in [0, 1e9], &gt; 0 for INVERSE_SQUARE; default 0: nothing outside of the shape</summary>
        public float Range;
        /// <summary>acceleration [m/s^2], in [-1e9, 1e9]; DRAG: k [1/s], in [0, 1e9]; GRAB: unused; default 1</summary>
        public float Strength;
        /// <summary>in the world, whatever the shape's rotation. UNIFORM: of the acceleration; VORTEX, DRAG and GRAB in
        /// 3D: the axis. Any length &gt; 1e-6; default (0, 1, 0)</summary>
        public Float3 Direction;
        /// <summary>DRAG and GRAB: the even part of w [m/s], in [-1e9, 1e9]; default 0</summary>
        public Float3 Velocity;
        /// <summary>DRAG, GRAB: turns about the axis through the shape's position [rad/s], in [-1e6, 1e6]; default 0</summary>
        public float Spin;
        /// <summary>unique number among the world's forces, by which snapshots match it; 0 (default): matched by the index
        /// of its identifier instead, see snapshot.h</summary>
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
        /// <summary>what it added to the momentum of nodes, over all substeps [kg m/s] (2D: per metre of depth), before
        /// materials and obstacles: m a dt, or for DRAG and GRAB -m k times the integral of v - w. GRAB with s = 1:
        /// plus what its nodes take from materials. Grabs that hold the same node count equal parts of that.</summary>
        public Double3 Impulse;
    }

    /// <summary>What one material has in a region.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct RegionShare
    {
        /// <summary>sizeof(pbmpm_region_share); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>of which these are the figures</summary>
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
        /// <summary>nearest to `position` with W_p &gt; 0; if several are equally near, the first in storage order</summary>
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
        /// <summary>centre of mass [m], from the shape's position, in the shape's own frame</summary>
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
        /// <summary>share of the obstacle's volume that is under, in [0, 1]</summary>
        public double Share;
        /// <summary>volume that is under [m^d]; 2D: per metre of depth</summary>
        public double Volume;
        /// <summary>centre of that volume [m], in the world; if it is 0, the obstacle's centre</summary>
        public Double3 Centre;
        /// <summary>of the matter around, at rest volume [kg/m^3]; 0 if there is none</summary>
        public double Density;
    }

    /// <summary>What a rigid body is. Fill it with pbmpm_rigid_def_init(), then change what differs; mass, centre, inertia and products are
    /// those of a pbmpm_mass_properties, or the host's own. It may change from call to call. In 2D positions and forces use components
    /// 0 and 1, inertia and torque component 2.
    ///
    /// A hinge: `moves` NONE, `turns` AXIS. A ball joint: `moves` NONE, `turns` ALL (2D: a hinge). A slider: `moves` AXIS, `turns`
    /// NONE.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct RigidDef
    {
        /// <summary>sizeof(pbmpm_rigid_def), set by pbmpm_rigid_def_init()</summary>
        public uint Size;
        /// <summary>1 (default): the domain's walls stop its corners and round parts (baked: its box). 0: off. Not with
        /// `moves` NONE</summary>
        public int StaysInside;
        /// <summary>how its centre of mass may move; NONE: its `pivot` stays in place instead. Default ALL</summary>
        public Freedom Moves;
        /// <summary>how it may turn. 2D: NONE, or else about the third axis. Default ALL</summary>
        public Freedom Turns;
        /// <summary>[kg] (2D: per metre of depth), in [1e-12, 1e15]; default 1</summary>
        public double Mass;
        /// <summary>centre of mass [m], from the shape's position, in the shape's own frame; within 1e9; default 0</summary>
        public Double3 Centre;
        /// <summary>as in pbmpm_mass_properties; positive definite, within 1e30. 2D: only zz counts. Default 1, 1, 1</summary>
        public Double3 Inertia;
        /// <summary>see pbmpm_mass_properties; default 0</summary>
        public Double3 Products;
        /// <summary>[m] `moves` NONE: the point that stays, from the shape's position, in its frame; within 1e9, default
        /// 0</summary>
        public Double3 Pivot;
        /// <summary>of `moves`, in the world, any length from 1e-6 to 1e9; default (0, 1, 0)</summary>
        public Double3 MoveAxis;
        /// <summary>of `turns`, in the world, any length from 1e-6 to 1e9; not used in 2D; default (0, 0, 1)</summary>
        public Double3 TurnAxis;
        /// <summary>the host's, beside gravity and matter, at the centre of mass [N]; within 1e30; default 0</summary>
        public Double3 Force;
        /// <summary>the host's, such as a motor's or a brake's [N m]; within 1e30; default 0</summary>
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

    /// <summary>Pose and motion of a rigid body. In 2D angular velocities use component 2, positions and velocities 0 and 1.
    /// pbmpm_rigid_begin() fills it; the host may set velocities. Snapshots do not hold it: keep a copy beside each snapshot.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct RigidState
    {
        /// <summary>sizeof(pbmpm_rigid_state), set by the caller before pbmpm_rigid_begin()</summary>
        public uint Size;
        /// <summary>must be 0</summary>
        public uint Reserved;
        /// <summary>of the shape [m] at the end of the next step; within 1e9. After
        /// pbmpm_world_shift_origin() subtract `moved`.</summary>
        public Double3 Position;
        /// <summary>quaternion (x, y, z, w) of length 0.5 to 2; 2D: x and y are 0</summary>
        public Double4 Rotation;
        /// <summary>of the centre of mass [m/s]; within 1e9</summary>
        public Double3 Velocity;
        /// <summary>[rad/s], in the world; within 1e9</summary>
        public Double3 AngularVelocity;
        /// <summary>by which the last call changed `velocity` [m/s]; the next call smooths with it</summary>
        public Double3 VelocityChange;
        /// <summary>the same of `angular_velocity` [rad/s]</summary>
        public Double3 AngularVelocityChange;
        /// <summary>[m] `moves` NONE: where the pivot stays. AXIS, PLANE: a point of the centre of mass's
        /// line or plane. ALL: unused. After pbmpm_world_shift_origin() subtract `moved`.</summary>
        public Double3 Point;
        /// <summary>V of the last call [kg], 0 if the body yielded; the library never reads it</summary>
        public double VirtualMass;
    }

    /// <summary>Figures of the last step. Times are of the whole step (all substeps); state is that at its end. Momentum and angular momentum
    /// are relative to the world's origin; in 2D only component 2 of the angular momentum is used. In 2D all are per metre of depth.</summary>
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
        /// <summary>blocks of 4^d cells with particles; liquid that flies far from all else is in none</summary>
        public uint ParticleBlocks;
        /// <summary>blocks of 4^d grid nodes that these touch</summary>
        public uint NodeBlocks;
        /// <summary>node-obstacle pairs in the last substep</summary>
        public uint Contacts;
        /// <summary>of the step</summary>
        public uint Substeps;
        /// <summary>per substep</summary>
        public uint Iterations;
        /// <summary>threads, or tasks per enqueue, that share the work</summary>
        public uint ThreadCount;
        /// <summary>wall time [ms] of the step</summary>
        public float MsTotal;
        /// <summary>... of it for sorting particles into blocks</summary>
        public float MsSort;
        /// <summary>moving particle data to the grid, gravity and forces</summary>
        public float MsScatter;
        /// <summary>finding nodes near obstacles</summary>
        public float MsContacts;
        /// <summary>the solver's iterations</summary>
        public float MsIterate;
        /// <summary>moving particles, and checking them</summary>
        public float MsIntegrate;
        /// <summary>root mean square of |PBMPM_VOLUME_RATIO - 1| over all particles</summary>
        public float VolumeErrorRms;
        /// <summary>the largest of these</summary>
        public float VolumeErrorMax;
        /// <summary>[m/s]</summary>
        public float MaxSpeed;
        /// <summary>largest particle displacement of the last substep [cells] (the Courant number)</summary>
        public float MaxDisplacement;
        /// <summary>[kg] (2D: this and all below per metre of depth)</summary>
        public double Mass;
        /// <summary>[kg m/s]</summary>
        public Double3 Momentum;
        /// <summary>about the origin [kg m^2/s], including the spin within particles (PBMPM_AFFINE_VELOCITY)</summary>
        public Double3 AngularMomentum;
        /// <summary>of the particles' velocities [J]</summary>
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
        /// <summary>of the last substep; CONVERGENT: the joint solver, or several that differ. Of several groups
        /// of islands iterations_used, residual and predicted_error are maxima; energy_checks_failed
        /// is the sum</summary>
        public Solver Solver;
        /// <summary>what ended the iterations of the last substep</summary>
        public Stop Stop;
        /// <summary>in the last substep, with repeated passes; deep sand may exceed settings.iterations</summary>
        public uint IterationsUsed;
        /// <summary>[cells] Dual: rms change of the stresses in the last iteration, at least that of the
        /// displacements that they cause. Primal: see docs/method.md, End. Paper's, explicit: 0</summary>
        public float Residual;
        /// <summary>predicted rms error of the displacements [cells]; 0 if residual is 0</summary>
        public float PredictedError;
        /// <summary>primal, alone or with the dual: bodies whose first solution had gained energy in the last
        /// substep. They searched further, then paid with velocities, or began again from their rigid
        /// motion: docs/method.md, Pieces that gain energy</summary>
        public uint EnergyChecksFailed;
        /// <summary>particles that the last substep did not move because they sleep</summary>
        public uint ParticlesAsleep;
        /// <summary>blocks that took no part in the last substep; particle_blocks counts those that did</summary>
        public uint BlocksAsleep;
        /// <summary>of particle_blocks, those that took part without being moved, beside awake blocks</summary>
        public uint BlocksDrowsy;
        /// <summary>blocks that woke in the last step, and by calls before it</summary>
        public uint BlocksWoken;
    }

    /// <summary>Something that happened and that the caller did not ask for.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Event
    {
        /// <summary>sizeof(pbmpm_event); set by the caller in the first element of an array</summary>
        public uint Size;
        /// <summary>what happened</summary>
        public EventKind Kind;
        /// <summary>how many particles (deletions: always 1)</summary>
        public uint Count;
        /// <summary>the particle, or one of several, see the kind; all zero: without one</summary>
        public ParticleId Particle;
        /// <summary>where it is [m], relative to the origin</summary>
        public Float3 Position;
        /// <summary>substep of the step, from 0</summary>
        public uint Substep;
        /// <summary>steps completed before it: one less than pbmpm_stats.step_count after that step</summary>
        public ulong Step;
    }

    /// <summary>What a surface is of, and how fine. Fill it with pbmpm_surface_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct SurfaceDef
    {
        /// <summary>sizeof(pbmpm_surface_def), set by pbmpm_surface_def_init()</summary>
        public uint Size;
        /// <summary>lattice points per cell and axis: 2 (default) or 1 (quarter of the triangles, half the
        /// time)</summary>
        public uint Subdivision;
        /// <summary>the surface is of these: `material_count` of them, each once</summary>
        public IntPtr Materials;
        /// <summary>0 (default): all materials</summary>
        public uint MaterialCount;
        /// <summary>filling at the surface, in [0.1, 0.9]; default 0.5: where matter ends. Lower: fatter</summary>
        public float Level;
        /// <summary>1 (default): layers and threads that are a particle thick are part of it, with about
        /// their volume. 0: they vanish</summary>
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
    /// <summary>The memory of one world. The library copies this structure when it creates the world. Functions and `user` must outlive the
    /// world. They are called from threads that call the library, and from a background step (async.h). Two threads never use one
    /// world's allocator at the same time. The functions must not call the library.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct Allocator
    {
        /// <summary>sizeof(pbmpm_allocator), set by the caller</summary>
        public uint Size;
        /// <summary>not null; may return null. Alignment: 2^n up to 64</summary>
        public IntPtr Allocate;
        /// <summary>not null. `size`: as it was asked for</summary>
        public IntPtr Release;
        /// <summary>passed on unchanged</summary>
        public IntPtr User;
    }

    /// <summary>Lets the host's job system run the library's parallel work. The library copies this structure when it creates the world.
    /// Functions and `user` must outlive the world.
    /// `enqueue` shall have task(i, context) called once for each i in [0, count), on any threads, in any order. It returns a handle of
    /// the host's own, null included. The library passes each handle to `finish` exactly once. `finish` returns when all calls of the
    /// task have returned.
    ///
    /// Tasks of one handle may wait for each other, for some milliseconds at most, and yield their core meanwhile. A task waits only
    /// for tasks that already run. So the host may also run them one after another.
    /// Only a background step calls enqueue and finish from within a task, see `nests`. There `finish` must run other tasks while it
    /// waits, or one worker must stay free. Else all workers may wait for each other (deadlock).
    ///
    /// One substep of 5 iterations calls enqueue about 10 times (paper's solver) or 30 times (dual). With the convergent solver that is
    /// for each group of islands with the same kinds of matter. Loops of less than some 40 microseconds run on the caller.
    ///
    /// Only one call on a world uses its hooks at a time. Concurrent readers work on their own thread. There is one exception: a
    /// background step calls enqueue while pbmpm_world_step_end() waits in `finish`.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct TaskHooks
    {
        /// <summary>sizeof(pbmpm_task_hooks); you set it</summary>
        public uint Size;
        /// <summary>1: tasks may call enqueue and finish; a background step then runs as a task, see async.h. 0: they may not</summary>
        public int Nests;
        /// <summary>not null; returns a handle</summary>
        public IntPtr Enqueue;
        /// <summary>not null; any thread may call it</summary>
        public IntPtr Finish;
        /// <summary>passed on unchanged</summary>
        public IntPtr User;
    }

    /// <summary>One line of the library's own table of layouts: a field of a public structure. With an empty field name it is the structure
    /// itself (offset 0, size of the whole). This structure and the identifiers never grow.</summary>
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
        /// <summary>element_count * dimension indices of vertices; null for a hull. The surface must be closed. All
        /// of it may be inside out; holes wind against the outside. Equal vertices count as one.</summary>
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

    /// <summary>A height field: heights over a regular lattice, solid from there down to its base. Sample (i, j) stands at i * spacing[0] and j
    /// * spacing[1] along the axes other than `up`: i along the lower one, j along the higher (up 1: x, z; 2D: i alone).
    /// Let bumpy ground go on for a cell or two inside the walls around it. Where it ends at their faces, water may keep moving.
    /// Where baked cells are wider than 1.5 cells of the world, matter may slip down there (PBMPM_ADVICE_COLLIDER_TOO_COARSE).</summary>
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
        /// <summary>of the lattice [m], in [1e-6, 1e6]; the whole is at most 1e6 m long; default 1</summary>
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
        /// <summary>rest volume of each particle [m^d], 1e-6 to 1e6 cell volumes; 0 (default): (dx/2)^d</summary>
        public float Volume;
        /// <summary>count * d floats [m], relative to the origin; inside the domain box if there is one</summary>
        public float* Positions;
        /// <summary>count * d floats [m/s], each in [-1e9, 1e9], or null for rest</summary>
        public float* Velocities;
        /// <summary>count floats: rest volumes [m^d], each 1e-6 to 1e6 cell volumes, or null: `volume` for all</summary>
        public float* Volumes;
        /// <summary>count values that the host chooses, see PBMPM_USER_VALUE; null (default): all 0</summary>
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

    /// <summary>A window on the world's own memory, read-only. Element (i, c) is at (const char *)data + i * stride + c * component_stride.
    /// The memory stays allocated until the world is destroyed. So an expired view may be read safely, but its values mean nothing.
    /// For what is drawn later, or by another thread, publish the field (async.h) or copy it (pbmpm_particles_copy()).</summary>
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
        /// <summary>valid while pbmpm_world_generation() returns this; published views: longer, see async.h</summary>
        public ulong Generation;
    }

    /// <summary>What pbmpm_particles_copy() writes for each particle. Fill it with pbmpm_copy_def_init(), then change what differs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct CopyDef
    {
        /// <summary>sizeof(pbmpm_copy_def), set by pbmpm_copy_def_init()</summary>
        public uint Size;
        /// <summary>bytes from one particle to the next, a multiple of 4; 0 (default): offset and fields, packed</summary>
        public uint Stride;
        /// <summary>time, from 0 (before the last step) to 1 (default: now). Positions are x - (1 - alpha) dt v, dt
        /// of the last step; other fields are those of now. With one substep that is exact but for what
        /// moves places alone: shifting (0.02 cells per axis), pushes of crowded matter (0.025). Further
        /// off is what an obstacle or a wall put back. So is what has another velocity than its way:
        /// with `flip`, with BDF2, or where the primal solver corrects velocities afterwards.</summary>
        public float Alpha;
        /// <summary>number of `fields`; 0 (default): POSITION, VELOCITY, MATERIAL</summary>
        public uint FieldCount;
        /// <summary>in the order in which they are written, without gaps; 4 bytes for each component</summary>
        public Field* Fields;
        /// <summary>1: POSITION and VELOCITY take 3 floats in 2D too, the third is 0. 0 (default): d floats</summary>
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
        /// <summary>what it is about</summary>
        public AdviceCode Code;
        /// <summary>the material; all zero: none</summary>
        public MaterialId Material;
        /// <summary>the obstacle; all zero: none</summary>
        public ColliderId Collider;
        /// <summary>what was found, as the code says</summary>
        public float Figure;
        /// <summary>the limit that the figure should keep to</summary>
        public float Bound;
        /// <summary>which setting would help</summary>
        public Change Change;
        /// <summary>what to set it to, within the setting's range</summary>
        public float Value;
        /// <summary>extra time per step [percent]; 100 doubles it; negative: not known</summary>
        public float Price;
        /// <summary>1: measured in the present state; 0: foreseen</summary>
        public int CameTrue;
        /// <summary>one sentence, constant, valid as long as the library; never null</summary>
        public IntPtr Text;
    }

    /// <summary>Where a mesh goes. A null pointer skips that output and its cost. Memory is the caller's; a float or index needs no
    /// alignment.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct SurfaceMesh
    {
        /// <summary>sizeof(pbmpm_surface_mesh), set by the caller</summary>
        public uint Size;
        /// <summary>bytes between vertices in the four float arrays, a multiple of 4; 0: packed. One record may
        /// hold all four.</summary>
        public uint Stride;
        /// <summary>3 floats per vertex [m], relative to the origin</summary>
        public float* Positions;
        /// <summary>3 floats per vertex: unit vector out of the matter, smooth</summary>
        public float* Normals;
        /// <summary>3 floats per vertex [m/s]: the mean of nearby particles</summary>
        public float* Velocities;
        /// <summary>def.material_count floats per vertex: shares of the nearby matter, which add up to 1</summary>
        public float* Weights;
        /// <summary>3 per triangle, counterclockwise from outside, of def.index_bytes each</summary>
        public IntPtr Indices;
        /// <summary>room in each vertex array [vertices]</summary>
        public uint VertexCapacity;
        /// <summary>room in `indices` [indices]</summary>
        public uint IndexCapacity;
        /// <summary>out: vertices of the mesh</summary>
        public uint VertexCount;
        /// <summary>out: indices of the mesh, 3 per triangle</summary>
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
        /// <summary>1: the colour is PBMPM_USER_VALUE (0 in a world without). 0 (default): by `palette`</summary>
        public int ColourFromUser;
        /// <summary>in (0, 100]; default 1. At 0.81 neighbours of an even lattice in 3D just touch.</summary>
        public float RadiusScale;
        /// <summary>1 (3D only): spray, which the default surface of `materials` leaves out; 0 (default)</summary>
        public int SprayOnly;
        /// <summary>must be 0</summary>
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

    /// <summary>Receives one line per notable event. Threads that call the library call it, and so do background steps; possibly several at
    /// once. The library's worker threads never call it. `message` is valid during the call only. `user` is passed on unchanged. It
    /// must not call the library.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void LogCallback(LogLevel level, IntPtr message, IntPtr user);

    /// <summary>Called where an assertion inside the library fails: with the condition, and its place in the sources. Return 0 to go on; the
    /// library's results are then meaningless. Any other number makes the library call abort().
    /// Any thread may call it, workers too, and several at once. It must not call the library.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int AssertCallback(IntPtr condition, IntPtr file, int line, IntPtr user);

    /// <summary>One share of parallel work. `index` counts from 0.</summary>
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

        /// <summary>A short constant name of a result ("PBMPM_ERROR_CAPACITY"); "unknown result" for other numbers. Never null, never to be
        /// freed. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_result_name(Result result);

        /// <summary>The message of the last call that failed on this thread, or an empty string. Never null. Valid until the next call that fails on
        /// this thread.
        /// Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_last_error();

        /// <summary>Sets (or, with null, removes) the process-wide log callback. `user` must stay valid until it is removed. Bindings need not use
        /// it: everything it says can also be polled. Always returns OK.
        /// Threads: any, but not while another thread is inside the library.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_set_log_callback(IntPtr callback, IntPtr user);

        /// <summary>Sets (or, with null, removes) the process-wide callback for assertions. `user` must stay valid until it is removed. Without a
        /// callback a line goes to standard error, and abort() is called.
        /// Errors: UNSUPPORTED: the library was built without assertions (the default; -DPBMPM_ASSERTS=ON builds it with them); then
        /// nothing is set.
        /// Threads: any, but not while another thread is inside the library.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_set_assert_callback(IntPtr callback, IntPtr user);

        /// <summary>The version of the loaded library, as major * 1000000 + minor * 1000 + patch. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_version();

        /// <summary>PBMPM_ABI_VERSION of the loaded library. A binding refuses to run when it differs from its own. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_abi_version();

        /// <summary>The instruction set in use. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Isa pbmpm_active_isa();

        /// <summary>The name of an instruction set ("AVX2"); never null. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_isa_name(Isa isa);

        /// <summary>1 if this library was built with the CMake option PBMPM_STRICT, else 0. Strict builds give the same results with every
        /// instruction set, bit for bit. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern int pbmpm_build_is_strict();

        /// <summary>The layouts of all public structures as this library was compiled. Every binding compares it with its own mirror when it
        /// loads. The table is constant and lives as long as the library. Errors: INVALID_ARGUMENT (null). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_layout_table(LayoutEntry** entries, uint* count);

        /// <summary>Destroys all worlds and joins all threads of the library, for hosts that unload it. Unloading does this too, but it cannot free
        /// worlds with a host's allocator. Afterwards the library may be used again. Always returns OK.
        /// Threads: any, but not while another call is under way.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shutdown();

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_def_init(MaterialDef* def, UIntPtr size);

        /// <summary>Which kinds of materials this library was built with: bit k (1u &lt;&lt; PBMPM_LIQUID, ...) is set for kind k. The CMake option
        /// PBMPM_MATERIALS chooses. Creating a kind that is left out is refused as UNSUPPORTED. A build with liquids alone is smaller.
        /// Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint pbmpm_materials_built();

        /// <summary>Adds a material to a world. One that no particle has costs neither memory nor time.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (kind or size unknown, or the kind is not built), CAPACITY, BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_create(WorldId world, MaterialDef* def, MaterialId* material);

        /// <summary>Reads a material. `def-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_get(WorldId world, MaterialId material, MaterialDef* def);

        /// <summary>How stiff the material is when the world is stepped by `dt` [s] with its present settings. `effective-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null; dt not in (0, 10]), UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_effective(WorldId world, MaterialId material, float dt, Effective* effective);

        /// <summary>Changes the parameters of a material (not its kind or density), from the next step on.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_set(WorldId world, MaterialId material, MaterialDef* def);

        /// <summary>Removes a material that no particle and no emitter uses. Errors: INVALID_ID, IN_USE, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_destroy(WorldId world, MaterialId material);

        /// <summary>Whether an identifier is that of a material of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
        /// which is no error.
        /// Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_material_is_valid(WorldId world, MaterialId material, int* valid);

        /// <summary>Lists the materials of the world, in no particular order. *count is how many there are; the first `capacity` of them are
        /// written to `materials`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_materials(WorldId world, MaterialId* materials, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_mesh_def_init(MeshDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_mesh_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_heights_def_init(HeightsDef* def, UIntPtr size);

        /// <summary>Bakes a closed mesh into the caller's `buffer` of `capacity` bytes. *bytes becomes the size that is needed. With a null buffer
        /// the call only says the size, at once: ask first, then bake. The memory that baking takes is the C library's and is given back.
        /// Errors: INVALID_ARGUMENT (a value out of range; a mesh that is open, partly wound the wrong way, or holds no volume: the
        /// message says where), UNSUPPORTED (size), OUT_OF_MEMORY, CAPACITY (the buffer is too small). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_mesh(MeshDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Bakes the convex hull of the vertices. As pbmpm_bake_mesh().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_hull(MeshDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Bakes a height field. As pbmpm_bake_mesh().</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_bake_heights(HeightsDef* def, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Checks the bytes of a baked solid and tells what it is. `data` may have any alignment. `info-&gt;size` must be set.
        /// Errors: INVALID_ARGUMENT (null), DAMAGED, UNSUPPORTED (size; a format of another version). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_inspect(IntPtr data, ulong size, BakedInfo* info);

        /// <summary>Copies a baked solid into a world. `data` may have any alignment, and may be freed afterwards.
        /// Errors: INVALID_ID, DAMAGED, UNSUPPORTED (a format of another version), INVALID_ARGUMENT (also: its dimension is not the
        /// world's), CAPACITY, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_create(WorldId world, IntPtr data, ulong size, BakedId* baked);

        /// <summary>What a loaded solid is. `info-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_get(WorldId world, BakedId baked, BakedInfo* info);

        /// <summary>Takes a solid out of the world. Errors: INVALID_ID; IN_USE (a collider refers to it); BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_baked_destroy(WorldId world, BakedId baked);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shape_init(Shape* shape, UIntPtr size);

        /// <summary>Writes the defaults. `size` is the caller's sizeof(*def). Members of a larger structure that this library does not know become
        /// 0.
        /// Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size below the first version's, between two versions', or above 4096).
        /// Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_def_init(WorldDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_world_def_init() does. Errors and threads: the same.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_settings_init(Settings* settings, UIntPtr size);

        /// <summary>Creates a world and takes its memory. On failure *world is the null identifier and nothing is held.
        /// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, CAPACITY (worlds), UNSUPPORTED (size), UNSUPPORTED_CPU, THREAD. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_create(WorldDef* def, WorldId* world);

        /// <summary>Destroys a world and everything in it. Its identifiers become invalid, and views of it must not be read any more. Waits for a
        /// background step.
        /// Errors: INVALID_ID (also on a second destroy), BUSY. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_destroy(WorldId world);

        /// <summary>Whether an identifier is that of a world: *valid is then 1, else 0, which is no error. A world that another thread or a
        /// background step is at work on is valid. Errors: INVALID_ARGUMENT (null). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_is_valid(WorldId world, int* valid);

        /// <summary>Lists all worlds of the process. *count is how many there are; the first `capacity` of them are written to `worlds`, which
        /// may be null with a capacity of 0. Another thread may have destroyed one before the call returns. Errors: INVALID_ARGUMENT
        /// (null). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_get_worlds(WorldId* worlds, uint capacity, uint* count);

        /// <summary>The definition the world was made from, with origin and domain where pbmpm_world_shift_origin() left them. `allocator` and
        /// `tasks` point to the world's own copies. `def-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED,
        /// BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_def(WorldId world, WorldDef* def);

        /// <summary>Reads the settings. `settings-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_settings(WorldId world, Settings* settings);

        /// <summary>Changes the settings, from the next step on.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, a value out of range), UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_set_settings(WorldId world, Settings* settings);

        /// <summary>Advances the world by `dt` seconds in `substeps` equal parts. `dt` must be in (0, 10]. A substep lasts at least 1e-25 s, and at
        /// least 1e-25 s per metre of cell size. Expires all views. Allocates memory only when matter occupies more blocks (4^d cells) than
        /// ever before.
        /// Errors: INVALID_ID, BUSY, FORKED; INVALID_ARGUMENT (dt out of range, or the explicit solver with a liquid without bulk_modulus);
        /// OUT_OF_MEMORY (the grid cannot grow).
        /// After OUT_OF_MEMORY earlier substeps of the call stay done, and the failed one is not. With PBMPM_SOLVER_CONVERGENT some islands
        /// may have moved by the failed substep already. Storage order may differ. Values of PBMPM_DEFORMATION that you set may be clamped
        /// to the material's range. With sleeping, what was at rest may have fallen asleep.
        /// Threads: exclusive; different worlds step at the same time.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step(WorldId world, float dt);

        /// <summary>Moves the origin by the multiple of 4 cells that is nearest to `wanted` [m], and writes that to `moved`. In 2D moved[2] is 0.
        /// For scenes so large that a float is too coarse for positions.
        /// All positions are then relative to the new origin: those of particles, obstacles, emitters, drains and forces, the domain and
        /// the kill bounds. world_def.origin grows by `moved`. Subtract `moved` from positions that the host keeps, such as `position` and
        /// `point` of a pbmpm_rigid_state. Matter goes on bit for bit as it would have. The exception is where it meets obstacles, walls,
        /// emitters, drains, forces or bounds: their positions are rounded to floats. Nothing wakes. Expires all views.
        /// Restoring an older snapshot restores the old origin. In a world with a domain such a restore returns FOREIGN.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, NaN, something would be out of its range), BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_shift_origin(WorldId world, Double3* wanted, Double3* moved);

        /// <summary>A number that changes whenever views expire: by steps, restores, shifts, and changes of particles. A view is valid while this
        /// number equals its `generation`. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_generation(WorldId world, ulong* generation);

        /// <summary>64-bit hash of all particles in storage order: position, velocity, affine velocity, VOLUME_RATIO, DEFORMATION, PRESSURE,
        /// material, mass. Equal for the same calls on the same binary and instruction set, for any number of threads. With a strict build
        /// (pbmpm_build_is_strict()) on any instruction set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_hash(WorldId world, ulong* hash);

        /// <summary>Writes the defaults. `size` is the caller's sizeof(*def). Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size).
        /// Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_def_init(ParticlesDef* def, UIntPtr size);

        /// <summary>Writes the defaults, as pbmpm_particles_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_fill_def_init(FillDef* def, UIntPtr size);

        /// <summary>Adds particles: all of them or none. `ids`: null or room for def-&gt;count identifiers. Expires all views.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (also NaN, infinity or a position outside the domain in any element); UNSUPPORTED
        /// (size); CAPACITY; OUT_OF_MEMORY (room for F with the first non-liquid particle, or for user values); BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_add(WorldId world, ParticlesDef* def, ParticleId* ids);

        /// <summary>Fills a shape (any kind but PBMPM_PLANE) with a lattice of spacing dx / particles_per_axis that is centred on it. Each particle
        /// has the rest volume of one lattice cell. Lattice points outside the domain box are left out, and those in an obstacle that acts
        /// on the material. Existing particles are not looked at, so two fills of one place overlap (PBMPM_ADVICE_OVERLAPS). Make room with
        /// pbmpm_particles_remove_in(). To keep a place empty, have a collider there while you fill. Expires all views.
        /// `added` (may be null): how many were added. With a CAPACITY error nothing is added, and it says how many the shape needs.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (also: no point is left, or the shape's bounds in the domain hold over 2^30 points);
        /// UNSUPPORTED (size); CAPACITY; OUT_OF_MEMORY (as above); BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_fill(WorldId world, FillDef* def, Shape* shape, uint* added);

        /// <summary>Removes particles by identifier. An identifier may be given twice. Expires all views.
        /// Errors: INVALID_ID (any of them; nothing is removed), INVALID_ARGUMENT (null with a count), BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_remove(WorldId world, ParticleId* ids, uint count);

        /// <summary>Removes all particles inside a shape; *removed (may be null) says how many. Expires all views.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_remove_in(WorldId world, Shape* shape, uint* removed);

        /// <summary>Number of live particles. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_count(WorldId world, uint* count);

        /// <summary>A view of a field. `view-&gt;size` must be set. The order of particles is the same in all views of one generation and changes with
        /// steps; their identity is PBMPM_PARTICLE.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size; no such field in this world), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_view(WorldId world, Field field, View* view);

        /// <summary>Writes the defaults, as pbmpm_particles_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_copy_def_init(CopyDef* def, UIntPtr size);

        /// <summary>Copies all particles into the caller's memory, for rendering and for uploads to a GPU. `def` may be null: the defaults. *count
        /// becomes the number of particles. `capacity`: bytes of `buffer`, any alignment. The order is that of views. Expires no view.
        /// To ask for *count first, pass a null `buffer` with capacity 0; the result is CAPACITY.
        ///
        /// Records for a GPU: with pads_vectors 1 they are the same in 2D and 3D. The default fields take 28 bytes: position (3 floats),
        /// velocity (3 floats), index of the material (uint32). HLSL structured buffers use this layout. Fields POSITION, MATERIAL,
        /// VELOCITY with stride 32 are {vec3, uint, vec3} of GLSL's std430. Bytes before `offset` and after the last field of a record are
        /// not written.
        ///
        /// A host that steps at a fixed rate draws between two states: `alpha` is the share of the way to the present one. So motion is
        /// even on any display. While a background step runs, it copies the published state, see async.h.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (null, a value out of range); UNSUPPORTED (size; a field that the world does not have);
        /// CAPACITY (the buffer is too small; nothing is written, *count is set); BUSY (also, while a background step runs: a field is
        /// not published, or VELOCITY is not and `alpha` is below 1); FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_copy(WorldId world, CopyDef* def, IntPtr buffer, ulong capacity, uint* count);

        /// <summary>Writes a field of some particles: count * components values, tightly packed: floats, or uint32 for USER_VALUE. With null `ids`
        /// the values are for all particles in storage order, and `count` must be their number. All or nothing; expires all views.
        /// Settable: POSITION (velocity stays), VELOCITY, AFFINE_VELOCITY, VOLUME_RATIO (liquid, in [0.05, 1.2]), PRESSURE (liquid, in [0,
        /// 1e30]: where the dual solver starts from), DEFORMATION (elastic, any finite matrix with entries up to 1e6), USER_VALUE (wakes
        /// nothing).
        /// Errors: INVALID_ID; INVALID_ARGUMENT (a value out of range, a field that cannot be set); UNSUPPORTED (a particle whose
        /// material has no such field); OUT_OF_MEMORY (room for PRESSURE or USER_VALUE); BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_set(WorldId world, Field field, ParticleId* ids, uint count, IntPtr values);

        /// <summary>Writes for each identifier its row in the current views; `rows` has room for `count`.
        /// Errors: INVALID_ID (no row is written), INVALID_ARGUMENT (null with a count), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_particles_find(WorldId world, ParticleId* ids, uint count, uint* rows);

        /// <summary>Particles inside a shape, in storage order. Writes up to `capacity` identifiers; *count is the full number. `ids` may be null
        /// when capacity is 0.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_shape(WorldId world, Shape* shape, ParticleId* ids, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_def_init(ColliderDef* def, UIntPtr size);

        /// <summary>Adds an obstacle, with the shape's pose at the start. It may stand on top of matter: that is pushed out over the next steps.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, CAPACITY, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_create(WorldId world, ColliderDef* def, Shape* shape, ColliderId* collider);

        /// <summary>Takes an obstacle away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_destroy(WorldId world, ColliderId collider);

        /// <summary>Whether an identifier is that of a collider of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
        /// which is no error.
        /// Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_is_valid(WorldId world, ColliderId collider, int* valid);

        /// <summary>Lists the colliders of the world, in no particular order. *count is how many there are; the first `capacity` of them are
        /// written to `colliders`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_colliders(WorldId world, ColliderId* colliders, uint capacity, uint* count);

        /// <summary>Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not.
        /// Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_get(WorldId world, ColliderId collider, ColliderDef* def, Shape* shape);

        /// <summary>Changes an obstacle, which keeps its identifier. With a null `def` or `shape` that part stays unchanged. So do members that an
        /// older caller's smaller structure lacks. A new shape is there at once, without velocity. It cancels a pending
        /// pbmpm_collider_move(), as `kinematic` 0 does.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_set(WorldId world, ColliderId collider, ColliderDef* def, Shape* shape);

        /// <summary>Moves a kinematic obstacle to a pose during the next step, and reaches it exactly. After that step it rests, so call this before
        /// every step. Its velocity follows from the distance; what matter feels of it is clamped to settings.max_displacement cells per
        /// substep.
        /// `rotation` may be null: unchanged.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: not kinematic), BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_move(WorldId world, ColliderId collider, Float3* position, Float4* rotation);

        /// <summary>Puts an obstacle somewhere at once, without velocity. Works for static ones too. `rotation` may be null: unchanged.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_teleport(WorldId world, ColliderId collider, Float3* position, Float4* rotation);

        /// <summary>Reads the impulse of the last step, summed over its substeps. About another point p it is angular + (position - p) x linear.
        /// `impulse-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null; it does not measure), UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_impulse(WorldId world, ColliderId collider, Impulse* impulse);

        /// <summary>The same for a wall of the domain: that at the lower (`upper` 0) or upper (1) end of an axis.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, no such wall, or world_def.domain_measures_impulse is 0), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_impulse(WorldId world, int axis, int upper, Impulse* impulse);

        /// <summary>Reads a wall: that at the lower (`upper` 0) or upper (1) end of an axis. `wall-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, or no such wall: also where world_def.domain_enabled is 0), UNSUPPORTED, BUSY,
        /// FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_wall_get(WorldId world, int axis, int upper, DomainWall* wall);

        /// <summary>Changes a wall from the next step on. Closing it moves matter from behind it onto it at once: remove that matter before, see
        /// pbmpm_particles_remove_in(). Wakes all matter. Errors as pbmpm_domain_wall_get(). Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_domain_wall_set(WorldId world, int axis, int upper, DomainWall* wall);

        /// <summary>Which materials touch the colliders that report touches, and where that has begun or ended since the last call. A particle
        /// touches an obstacle within half a cell of it, and a sensor that it is inside. Call it once per step: a touch that begins and
        /// ends between two calls is not seen. Destroying a collider ends its touches without an ENDED record.
        /// *count is how many touches there are; the first `capacity` of them are written. `touches` may be null with a capacity of 0; else
        /// touches[0].size must be set. If `capacity` is below *count, the next call still compares with the call before this one. Costs a
        /// look at the particles near those colliders.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_touches(WorldId world, Touch* touches, uint capacity, uint* count);

        /// <summary>Particles inside a collider (deeper than 1/100 cell), sensors included. Arguments as in pbmpm_query_shape().
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), OUT_OF_MEMORY (see query.h), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_collider(WorldId world, ColliderId collider, ParticleId* ids, uint capacity, uint* count);

        /// <summary>What will go wrong with the present scene and settings when the world is stepped by `dt` [s]. It also tells what came true in
        /// the steps so far. Changes nothing. What is foreseen comes from formulas and measured limits, for the matter that is there or
        /// that emitters bring. An empty list is no promise.
        ///
        /// Writes up to `capacity` records in the order of their codes' numbers; *count is the full number. `array` may be null when
        /// capacity is 0; otherwise array[0].size must be set. Costs a quarter to a half of a step of five iterations, and only when
        /// called. It takes memory to sort cells, and gives it back.
        /// Errors: INVALID_ID; INVALID_ARGUMENT (null, dt not in (0, 10]); UNSUPPORTED (size); OUT_OF_MEMORY; BUSY; FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_advice(WorldId world, float dt, Advice* array, uint capacity, uint* count);

        /// <summary>A short constant name of a code ("PBMPM_ADVICE_NO_GRAVITY"); "PBMPM_ADVICE_UNKNOWN" for other numbers; never null.
        /// Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_advice_name(AdviceCode code);

        /// <summary>The unit of a code's figure and bound as constant text ("cells"); never null. Empty if there is no unit, if it depends on the
        /// case, or if the code is unknown. Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern IntPtr pbmpm_advice_unit(AdviceCode code);

        /// <summary>Which fields can be viewed while a step runs: `count` of them, each once; 0: none. Default: POSITION, VELOCITY, MATERIAL and
        /// PARTICLE. A published field that the world does not have yet (PRESSURE, DEFORMATION) costs memory, too, though it cannot be
        /// viewed. Takes effect, and memory, with the next pbmpm_world_step_begin().
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null with a count, unknown or repeated field), OUT_OF_MEMORY, BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_publish(WorldId world, Field* fields, uint count);

        /// <summary>Begins a step of `dt` seconds and returns. Expires all views but those of the state that the previous begin published: see
        /// above.
        /// Errors: INVALID_ID, INVALID_ARGUMENT and FORKED as pbmpm_world_step(); BUSY (also: a step is under way); OUT_OF_MEMORY (room
        /// for the published fields), THREAD (no thread for the step): then no step was begun and nothing has changed.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_begin(WorldId world, float dt);

        /// <summary>Ends a step that was begun, and gives its result: what pbmpm_world_step() would have given. With `wait` 0 it returns BUSY while
        /// the step runs; the log callback is not called. With another number it waits. The published state stays readable, see above.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (no step is under way), BUSY, FORKED; of the step: OUT_OF_MEMORY. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_end(WorldId world, int wait);

        /// <summary>Whether the step that was begun is done, so that pbmpm_world_step_end() will not wait: *done is then 1, else 0. Ends nothing and
        /// waits for nothing; made to be asked in each frame. Where the step is a task of the host and no other thread runs tasks, it never
        /// says yes: there end the step with a wait.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null; no step is under way), BUSY, FORKED; *done is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_step_done(WorldId world, int* done);

        /// <summary>Lines that show obstacles, regions and the grid. Balls and capsules are drawn as circles of 24 lines, planes as a square of 20
        /// cells (2D: a line) around their position, baked solids by contours of their surface. `parts`: a sum of pbmpm_debug_part. *count
        /// is how many lines there are; the first `capacity` of them are written to `lines`, which may be null with a capacity of 0. Costs
        /// what it draws, and only when called.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null, unknown parts), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_debug_lines(WorldId world, uint parts, Line* lines, uint capacity, uint* count);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_def_init(DrainDef* def, UIntPtr size);

        /// <summary>Adds a drain. `shape`: any kind but PBMPM_BAKED.
        /// Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_create(WorldId world, DrainDef* def, Shape* shape, DrainId* drain);

        /// <summary>Takes a drain away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_destroy(WorldId world, DrainId drain);

        /// <summary>Whether an identifier is that of a drain of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
        /// which is no error.
        /// Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_is_valid(WorldId world, DrainId drain, int* valid);

        /// <summary>Lists the drains of the world, in no particular order. *count is how many there are; the first `capacity` of them are written
        /// to `drains`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_drains(WorldId world, DrainId* drains, uint capacity, uint* count);

        /// <summary>Reads the definition and the shape. Either may be null; set `size` in what is not.
        /// Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_get(WorldId world, DrainId drain, DrainDef* def, Shape* shape);

        /// <summary>Changes a drain (its place, too). With a null `def` or `shape` that part stays unchanged. So do members that an older caller's
        /// smaller structure lacks. The counts are kept.
        /// Errors as pbmpm_drain_create(), except CAPACITY and OUT_OF_MEMORY. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_set(WorldId world, DrainId drain, DrainDef* def, Shape* shape);

        /// <summary>Counts since creation. `status-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_drain_status_get(WorldId world, DrainId drain, DrainStatus* status);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_kill_bounds_init(KillBounds* bounds, UIntPtr size);

        /// <summary>Sets or removes the bounds. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_set_kill_bounds(WorldId world, KillBounds* bounds);

        /// <summary>Reads the bounds. `bounds-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_kill_bounds(WorldId world, KillBounds* bounds);

        /// <summary>Reads the totals. `flow-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_flow(WorldId world, Flow* flow);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_def_init(EmitterDef* def, UIntPtr size);

        /// <summary>Adds an emitter; it begins with the next step. `shape`: a box, ball or capsule (with PBMPM_EMIT_DISC any kind). Its bounds hold
        /// at most 2^22 cells and lie within 2^21 cells of the origin.
        /// Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_create(WorldId world, EmitterDef* def, Shape* shape, EmitterId* emitter);

        /// <summary>Takes an emitter away; its particles stay. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_destroy(WorldId world, EmitterId emitter);

        /// <summary>Whether an identifier is that of an emitter of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
        /// which is no error.
        /// Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_is_valid(WorldId world, EmitterId emitter, int* valid);

        /// <summary>Lists the emitters of the world, in no particular order. *count is how many there are; the first `capacity` of them are
        /// written to `emitters`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_emitters(WorldId world, EmitterId* emitters, uint capacity, uint* count);

        /// <summary>Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not.
        /// Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_get(WorldId world, EmitterId emitter, EmitterDef* def, Shape* shape);

        /// <summary>Changes an emitter. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller
        /// structure lacks. The counts are kept, and so is the fraction of a particle that was due. A new pose is taken at once. It cancels
        /// a pending pbmpm_emitter_move().
        /// Errors as pbmpm_emitter_create(), except CAPACITY and OUT_OF_MEMORY. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_set(WorldId world, EmitterId emitter, EmitterDef* def, Shape* shape);

        /// <summary>Moves an emitter to a pose during the next step; particles are born all along the way. Their velocity does not include the
        /// emitter's own. If its way adds more than 2^22 grid nodes in a substep, it jumps to the pose at once. `rotation` may be null:
        /// unchanged.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_move(WorldId world, EmitterId emitter, Float3* position, Float4* rotation);

        /// <summary>Counts since creation. `status-&gt;size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_emitter_status_get(WorldId world, EmitterId emitter, EmitterStatus* status);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_def_init(ForceDef* def, UIntPtr size);

        /// <summary>Adds a force that is felt around a shape of any kind but PBMPM_BAKED.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_create(WorldId world, ForceDef* def, Shape* shape, ForceId* force);

        /// <summary>Takes a force away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_destroy(WorldId world, ForceId force);

        /// <summary>Whether an identifier is that of a force of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
        /// which is no error.
        /// Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_is_valid(WorldId world, ForceId force, int* valid);

        /// <summary>Lists the forces of the world, in no particular order. *count is how many there are; the first `capacity` of them are written
        /// to `forces`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_forces(WorldId world, ForceId* forces, uint capacity, uint* count);

        /// <summary>Reads the definition and the shape. Either may be null; set `size` in what is not.
        /// Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_get(WorldId world, ForceId force, ForceDef* def, Shape* shape);

        /// <summary>Changes a force (its kind and place, too), from the next step on. With a null `def` or `shape` that part stays unchanged. So
        /// do members that an older caller's smaller structure lacks. Errors as pbmpm_force_create(), except CAPACITY and OUT_OF_MEMORY.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_set(WorldId world, ForceId force, ForceDef* def, Shape* shape);

        /// <summary>Figures of the last step. `status-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_force_status_get(WorldId world, ForceId force, ForceStatus* status);

        /// <summary>What is inside a shape, by material: one entry for each material that has particles there, in the order of their indices. Writes
        /// up to `capacity` entries; *count is the full number. `shares` may be null when capacity is 0; otherwise shares[0].size must be
        /// set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_region(WorldId world, Shape* shape, RegionShare* shares, uint capacity, uint* count);

        /// <summary>Fields at points. `points`: count * d floats [m]. Each of the others may be null:
        /// `filling`: count floats, as defined above;
        /// `density`: count floats, sum_p m_p W_p / dx^d [kg/m^3] (2D: kg/m^2);
        /// `velocity`: count * d floats, sum_p m_p W_p (v_p + C_p (x - x_p)) / sum_p m_p W_p [m/s], C_p the affine velocity; 0 where there
        /// is no matter. A velocity that is linear in x comes out exactly.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null points, a coordinate that is not finite), OUT_OF_MEMORY, BUSY, FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_points(WorldId world, float* points, uint count, float* filling, float* density, float* velocity);

        /// <summary>The highest matter over (or under) points. "Up" is the unit vector u along `direction` (d floats, any length above 1e-6); null:
        /// against gravity.
        /// `points`: count * d floats [m]. `level`: filling that counts as matter, in (0, 100]; 0.5 is the surface.
        /// `heights`: count floats, the surface's coordinate u . x along u [m]; -infinity if the line through the point along u meets no
        /// matter. Samples on the line through x are x + k dx/4 u, k any integer. The surface is found between the highest sample that
        /// reaches `level` and the next, by 12 bisections.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: null direction without gravity), OUT_OF_MEMORY, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_heights(WorldId world, float* points, uint count, float* direction, float level, float* heights);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_ray_init(Ray* ray, UIntPtr size);

        /// <summary>The first point along a ray where the filling reaches the level. Samples lie dx/4 apart, the first one at the origin. The point
        /// is found between the last sample below the level and the next, by 12 bisections. A ray that begins in matter hits at distance 0.
        /// `hit-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_query_ray(WorldId world, Ray* ray, RayHit* hit);

        /// <summary>Mass properties of a shape. Boxes, balls and capsules: exact. Baked solids: sums over the nodes of the grid, in which a cell
        /// that the surface crosses counts by its share; a solid 64 cells long errs by less than 1/100. `mass-&gt;size` must be set.
        /// `density`: [kg/m^3], in [1e-6, 1e9].
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: a plane, which has no volume), UNSUPPORTED, BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_shape_mass(WorldId world, Shape* shape, float density, MassProperties* mass);

        /// <summary>How much of an obstacle is under matter. The surface of the matter around it is continued through the obstacle as a plane; what
        /// lies on the matter's side is under. No gravity is needed, and the plane may lie at any slope. `material`: null counts all
        /// matter, a load on top included; else only that material. So name the liquid where a raft carries a load of another material.
        ///
        /// Measured on a lattice of the world's cells around the obstacle; for obstacles longer than 64 cells the lattice is coarser.
        /// Matter at a node is the filling of query.h, divided by the share that obstacles and walls leave open there. Where they leave
        /// nothing open, the nodes next to it count. For obstacles 8 cells long the volume errs by less than a layer of 0.4 cells. On a
        /// floor it errs by less than 0.8. A thin jet at one side counts for nothing. But under a film of half a cell or more nearly all of
        /// the obstacle counts, see docs/limits.md.
        /// `submersion-&gt;size` must be set. The first call takes memory of the world, and keeps it.
        /// Errors: INVALID_ID (also: the material), INVALID_ARGUMENT (also: a plane), UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED.
        /// Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_collider_submerged(WorldId world, ColliderId collider, MaterialId* material, Submersion* submersion);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_def_init(RigidDef* def, UIntPtr size);

        /// <summary>Fills `state` for a body at rest at its obstacle's pose, `point` included. `state-&gt;size` must be set. Changes nothing in the
        /// world.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (also: the obstacle is a plane, not kinematic or measures no impulse), UNSUPPORTED, BUSY,
        /// FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_begin(WorldId world, ColliderId collider, RigidDef* def, RigidState* state);

        /// <summary>Advances a body by `dt` seconds, the same as of the pbmpm_world_step() that follows, and its obstacle by pbmpm_collider_move().
        /// Call it once before each step; a second call would apply the last step's impulse again. Only `state` and the obstacle's target
        /// change.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (as pbmpm_rigid_begin() and pbmpm_world_step(); also a place out of range), UNSUPPORTED,
        /// OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_rigid_advance(WorldId world, ColliderId collider, RigidDef* def, RigidState* state, float dt);

        /// <summary>Wakes all blocks within two cells of a shape, or all blocks of the world if `shape` is null. They stay awake for another
        /// sleep_time at least. Needed only where something happens that the library cannot know of. Does nothing in a world that does not
        /// sleep. `shape-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_wake(WorldId world, Shape* shape);

        /// <summary>How large a snapshot is now. *bytes changes with particles, their fields, objects and sleeping blocks. `bytes_per_particle` (may
        /// be null): the part of *bytes that each particle takes.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_size(WorldId world, ulong* bytes, uint* bytesPerParticle);

        /// <summary>Writes a snapshot into the caller's memory, of any alignment. `capacity`: bytes there. *bytes (may be null) becomes the size of
        /// the snapshot, on success and on CAPACITY. Takes no memory of the world and expires no views.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), CAPACITY (less room than pbmpm_snapshot_size() says; nothing is written), BUSY,
        /// FORKED.
        /// Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_save(WorldId world, IntPtr buffer, ulong capacity, ulong* bytes);

        /// <summary>Puts a world back into the state of a snapshot, of any alignment. `bytes`: as many as were written, or more. Everything is
        /// checked first: on failure nothing has changed. All particles of before are gone; identifiers of particles are those of the
        /// snapshot, and live in every world that it was restored into. Identifiers of all other objects stay the world's own. Views
        /// expire, events are cleared, and the figures of the last step are 0 until the next one. Rigid bodies: restore your own copies of
        /// pbmpm_rigid_state as well.
        ///
        /// The world must have the snapshot's dimension, cell size, domain box and domain_friction; materials with equal parameters;
        /// colliders with equal shapes and definitions, except pose, key and user_data; the same emitters, drains and forces, by key or
        /// index; and room for the particles and their identifiers. Settings are the snapshot's: read them before and set them again to
        /// keep your own.
        ///
        /// `flags`: 0, or PBMPM_RESTORE_KEEP_PARAMETERS. With it these may differ and stay the world's: settings, kill bounds,
        /// domain_friction, walls of the domain, colliders, and materials but for their kind and density; also the definitions of emitters,
        /// drains and forces. Poses, counts and which of them are enabled come from the snapshot. Objects that only the world has stay as
        /// they are. Objects that only the snapshot has are left out; a material that particles need must be there. All matter is awake.
        ///
        /// Errors: DAMAGED (truncated, a byte has changed, or no snapshot at all); FOREIGN (a world that differs, or another version of
        /// the format); CAPACITY (particles or identifiers); OUT_OF_MEMORY (fields that the world has not used yet); INVALID_ID,
        /// INVALID_ARGUMENT (null, unknown flags), BUSY, FORKED. Threads: exclusive.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_snapshot_restore(WorldId world, IntPtr snapshot, ulong bytes, uint flags);

        /// <summary>All figures, of the last step and of the present state. The latter take a pass over the particles on the world's threads. Sums
        /// do not depend on the number of threads. Before the first step times and step counts are 0. `stats-&gt;size` must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_stats(WorldId world, Stats* stats);

        /// <summary>The figures that a step leaves behind, without a pass over anything: made to be asked in each frame. These need a pass and are
        /// 0: volume_error_rms, volume_error_max, max_speed, mass, momentum, angular_momentum, kinetic_energy, potential_energy and
        /// lane_occupancy. While a background step runs they are those of the step before it, see async.h.
        /// Errors: as pbmpm_world_get_stats(). Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_get_step_stats(WorldId world, Stats* stats);

        /// <summary>Events of the last step, and of calls since then. Writes up to `capacity` of them; *count is the number that the world keeps, at
        /// most PBMPM_MAX_EVENTS. *missed (may be null) counts those that it had no room to keep; pbmpm_stats has totals. `events` may be
        /// null when capacity is 0; otherwise events[0].size must be set.
        /// Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Threads: shared.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_world_events(WorldId world, Event* events, uint capacity, uint* count, uint* missed);

        /// <summary>Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_surface_def_init(SurfaceDef* def, UIntPtr size);

        /// <summary>Makes the surface. `def` may be null: the defaults. `mesh-&gt;size` must be set. With all pointers null it only counts. A host
        /// whose buffers were too small enlarges them and calls again: what the first call computed is kept.
        ///
        /// Spray is no part of it: particles that are alone, and drops of less than a cell with nothing else within some 4 cells.
        /// pbmpm_surface_points() with spray_only gives them.
        /// Errors: INVALID_ID (also: a material); INVALID_ARGUMENT (null, a value out of range, weights without materials); CAPACITY
        /// (the buffers are too small, or there are more than 65535 vertices for indices of 2 bytes; only the counts are written);
        /// UNSUPPORTED (size; the world is in 2D); OUT_OF_MEMORY; BUSY (also: another thread makes a surface of this world, or a
        /// background step runs); FORKED. Threads: shared, but see above.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_surface_extract(WorldId world, SurfaceDef* def, SurfaceMesh* mesh);

        /// <summary>Writes the defaults, as pbmpm_surface_def_init() does.</summary>
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern Result pbmpm_points_def_init(PointsDef* def, UIntPtr size);

        /// <summary>Particles as points for splatting, in the order of views. `def` may be null: the defaults. *count becomes their number; `points`
        /// has room for
        /// `capacity` of them, and may be null with a capacity of 0.
        /// Errors as pbmpm_surface_extract(), but in 2D UNSUPPORTED only with spray_only. CAPACITY: only *count is written.
        /// Threads: shared, but see above.</summary>
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
