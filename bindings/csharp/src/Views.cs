using System;
using Pbmpm.Native;

// Windows on memory of the library. They are structures, so taking one makes no garbage. They hold the world, and they
// refuse to read when it has changed since.
namespace Pbmpm
{
    /// <summary>What all views of particles share: 4-byte values at two strides.</summary>
    internal readonly unsafe struct Window
    {
        readonly World world;
        readonly View view;

        public Window(World world, View view)
        {
            this.world = world;
            this.view = view;
        }

        public int Count => (int)view.Count;
        public int Components => (int)view.Components;
        public bool IsCurrent => world != null && world.IsCurrent(view.Generation);
        public bool IsPacked => view.ComponentStride == sizeof(uint) && view.Stride == view.Components * sizeof(uint);
        public long Stride => (long)view.Stride;
        public long ComponentStride => view.ComponentStride;

        public IntPtr Data
        {
            get
            {
                RequireCurrent();
                return view.Data;
            }
        }

        /// <summary>The bits of one value.</summary>
        public uint Read(int particle, int component)
        {
            RequireCurrent();
            if ((uint)particle >= view.Count) throw new ArgumentOutOfRangeException(nameof(particle));
            if ((uint)component >= view.Components) throw new ArgumentOutOfRangeException(nameof(component));
            var value = *(uint*)((byte*)view.Data + particle * Stride + component * ComponentStride);
            GC.KeepAlive(world);
            return value;
        }

        public void CopyTo(Numbers target)
        {
            RequireCurrent();
            target.RequireRoom(nameof(target), Components, Count);
            var next = target.Address();
            for (var particle = 0; particle < Count; particle++)
            {
                var first = (byte*)view.Data + particle * Stride;
                for (var component = 0; component < Components; component++)
                    *next++ = *(float*)(first + component * ComponentStride);
                if (target.IsWiderThan(Components)) *next++ = 0;
            }
            GC.KeepAlive(world);
        }

        void RequireCurrent()
        {
            if (!IsCurrent) throw new ExpiredViewException();
        }
    }

    /// <summary>Numbers of all particles: vectors, matrices (row-major) or single ones.</summary>
    public readonly unsafe partial struct FloatView
    {
        readonly Window window;

        internal FloatView(Window window)
        {
            this.window = window;
        }

        /// <summary>Number of particles.</summary>
        public int Count => window.Count;

        /// <summary>Numbers per particle.</summary>
        public int Components => window.Components;

        /// <summary>False when the world has changed since; then reading throws <see cref="ExpiredViewException"/>.</summary>
        public bool IsCurrent => window.IsCurrent;

        public float this[int particle, int component]
        {
            get
            {
                var bits = window.Read(particle, component);
                return *(float*)&bits;
            }
        }

        /// <summary>The vector of a particle; in 2D its third component is 0.</summary>
        /// <exception cref="InvalidOperationException">The field does not hold vectors.</exception>
        public Float3 Vector(int particle)
        {
            if (Components != 2 && Components != 3) throw new InvalidOperationException("this field does not hold vectors");
            return new Float3(this[particle, 0], this[particle, 1], Components == 3 ? this[particle, 2] : 0);
        }

        /// <summary>Copies all values, those of one particle side by side, to the begin of an array.</summary>
        public void CopyTo(float[] target)
        {
            fixed (float* first = target) window.CopyTo(Numbers.Plain(first, target));
        }

        /// <summary>Address of the first value, for engines that alias native memory. Element (i, c) is at
        /// Data + i * Stride + c * ComponentStride; to be read only while <see cref="IsCurrent"/>.</summary>
        public IntPtr Data => window.Data;

        /// <summary>Bytes from one particle to the next.</summary>
        public long Stride => window.Stride;

        /// <summary>Bytes from one component to the next.</summary>
        public long ComponentStride => window.ComponentStride;
    }

    /// <summary>A number of each particle: the index of its material's identifier, or the host's own.</summary>
    public readonly struct NumberView
    {
        readonly Window window;

        internal NumberView(Window window)
        {
            this.window = window;
        }

        /// <summary>Number of particles.</summary>
        public int Count => window.Count;

        /// <summary>False when the world has changed since; then reading throws <see cref="ExpiredViewException"/>.</summary>
        public bool IsCurrent => window.IsCurrent;

        public uint this[int particle] => window.Read(particle, 0);
    }

    /// <summary>The identifiers of all particles.</summary>
    public readonly struct ParticleView
    {
        readonly Window window;

        internal ParticleView(Window window)
        {
            this.window = window;
        }

        /// <summary>Number of particles.</summary>
        public int Count => window.Count;

        /// <summary>False when the world has changed since; then reading throws <see cref="ExpiredViewException"/>.</summary>
        public bool IsCurrent => window.IsCurrent;

        public ParticleId this[int particle] =>
            new ParticleId { Index = window.Read(particle, 0), Generation = window.Read(particle, 1) };
    }

    /// <summary>Events of a world; they end with its next step or change.</summary>
    public readonly struct EventList
    {
        readonly World world;
        readonly Event[] list;
        readonly ulong generation;

        internal EventList(World world, Event[] list, int count, uint missed)
        {
            this.world = world;
            this.list = list;
            generation = world.Generation;
            Count = count;
            Missed = missed;
        }

        public int Count { get; }

        /// <summary>How many more happened than the world has room for; totals are in <see cref="Stats"/>.</summary>
        public uint Missed { get; }

        public Event this[int index]
        {
            get
            {
                if ((uint)index >= (uint)Count) throw new ArgumentOutOfRangeException(nameof(index));
                if (!world.IsCurrent(generation)) throw new ExpiredViewException();
                return list[index];
            }
        }

        /// <summary>For foreach, without garbage.</summary>
        public Enumerator GetEnumerator()
        {
            return new Enumerator(this);
        }

        public struct Enumerator
        {
            readonly EventList events;
            int index;

            internal Enumerator(EventList events)
            {
                this.events = events;
                index = -1;
            }

            public Event Current => events[index];

            public bool MoveNext()
            {
                return ++index < events.Count;
            }
        }
    }
}
