using System;
using System.Collections.Generic;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>The worlds of this domain that the library has. Each is destroyed once, by whoever is first: its owner, its
    /// finalizer, or the end of the domain or the process, when neither may come.</summary>
    internal static unsafe class LiveWorlds
    {
        static readonly Dictionary<ulong, Lent> Lendings = new Dictionary<ulong, Lent>();

        static LiveWorlds()
        {
            DomainEnd.Calls(DestroyAll);
        }

        public static WorldId Create(WorldDef definition, HostTasks tasks, HostMemory memory)
        {
            var lent = new Lent(tasks, memory);
            var hooks = HostTasks.Hooks(tasks, lent.Tasks);
            var allocator = HostMemory.Hooks(lent.Memory);
            if (tasks != null) definition.Tasks = (IntPtr)(&hooks);
            if (memory != null) definition.Allocator = (IntPtr)(&allocator);
            WorldId made;
            var result = Methods.pbmpm_world_create(&definition, &made);
            if (result != Result.Ok) lent.Return();
            Library.Require(result);
            lock (Lendings) Lendings.Add(KeyOf(made), lent);
            return made;
        }

        /// <summary>Destroys a world unless that was done. When the library refuses it is still there.</summary>
        public static Result Destroy(WorldId world)
        {
            Lent lent;
            var key = KeyOf(world);
            lock (Lendings)
            {
                if (!Lendings.TryGetValue(key, out lent)) return Exists(world) ? Result.ErrorBusy : Result.Ok; // another thread is at it
                Lendings.Remove(key);
            }
            var result = Methods.pbmpm_world_destroy(world); // not locked: it may call the host
            if (result == Result.ErrorInvalidId) result = Result.Ok; // Library.Shutdown() was first
            if (result == Result.Ok) lent.Return();
            else lock (Lendings) Lendings.Add(key, lent);
            return result;
        }

        static bool Exists(WorldId world)
        {
            int valid;
            return Methods.pbmpm_world_is_valid(world, &valid) == Result.Ok && valid != 0;
        }

        static void DestroyAll(object sender, EventArgs nothing)
        {
            ulong[] keys;
            lock (Lendings)
            {
                keys = new ulong[Lendings.Count];
                Lendings.Keys.CopyTo(keys, 0);
            }
            foreach (var key in keys) Destroy(new WorldId { Index = (uint)(key >> 32), Generation = (uint)key });
        }

        static ulong KeyOf(WorldId world)
        {
            return (ulong)world.Index << 32 | world.Generation;
        }
    }
}
