using System;
using Pbmpm.Native;

namespace Pbmpm
{
    // Snapshots, steps in the background, sleep
    public sealed unsafe partial class World
    {
        /// <summary>Bytes that a snapshot needs now.</summary>
        public long SnapshotSize
        {
            get
            {
                ulong bytes;
                Done(Methods.pbmpm_snapshot_size(Id, &bytes, null));
                return (long)bytes;
            }
        }

        /// <summary>Writes the dynamic state to the begin of an array and says how many bytes it took.</summary>
        public long SaveTo(byte[] buffer)
        {
            if (buffer == null) throw new ArgumentNullException(nameof(buffer));
            ulong bytes;
            fixed (byte* first = buffer) Done(Methods.pbmpm_snapshot_save(Id, (IntPtr)first, (ulong)buffer.Length, &bytes));
            return (long)bytes;
        }

        /// <summary>Puts the world back into the state of a snapshot: of this world, or of one with the same box, materials
        /// and obstacles. What does not fit or is damaged is refused, and nothing has changed.</summary>
        /// <param name="snapshot">From <see cref="SaveTo"/>.</param>
        /// <param name="flags">For saves of before a patch: the world keeps its own parameters.</param>
        public void Restore(byte[] snapshot, RestoreFlags flags = 0)
        {
            if (snapshot == null) throw new ArgumentNullException(nameof(snapshot));
            fixed (byte* first = snapshot) Changed(Methods.pbmpm_snapshot_restore(Id, (IntPtr)first, (ulong)snapshot.Length, (uint)flags));
        }

        /// <summary>Begins a step of <paramref name="seconds"/> and returns. Until it ends, views of published fields show the
        /// state from which it began; other calls get <see cref="Result.ErrorBusy"/>. Those views stay current until the next begin but one, and
        /// any thread may read them: a renderer that is a frame late reads a whole old frame.</summary>
        public void BeginStep(float seconds)
        {
            Changed(Methods.pbmpm_world_step_begin(Id, seconds));
            publishedBefore = published;
            published = generation;
        }

        /// <summary>Waits for the step that was begun, and ends it.</summary>
        public void EndStep()
        {
            Changed(Methods.pbmpm_world_step_end(Id, 1));
        }

        /// <summary>Whether the step that was begun is done, so that <see cref="EndStep"/> will not wait. Made to be asked in each
        /// frame.</summary>
        public bool IsStepDone
        {
            get
            {
                int done;
                Done(Methods.pbmpm_world_step_done(Id, &done));
                return done != 0;
            }
        }

        /// <summary>Ends the step that was begun if it is done; false if it is still under way.</summary>
        public bool TryEndStep()
        {
            var result = Methods.pbmpm_world_step_end(Id, 0);
            if (result == Result.ErrorBusy)
            {
                GC.KeepAlive(this);
                return false;
            }
            Changed(result);
            return true;
        }

        /// <summary>Which fields can be viewed while a step runs in the background; at first positions, velocities, materials
        /// and identifiers.</summary>
        public void Publish(params Field[] fields)
        {
            if (fields == null) throw new ArgumentNullException(nameof(fields));
            fixed (Field* first = fields) Done(Methods.pbmpm_world_publish(Id, first, (uint)fields.Length));
        }

        /// <summary>Wakes all matter that sleeps.</summary>
        public void Wake()
        {
            Done(Methods.pbmpm_world_wake(Id, null));
        }

        /// <summary>Wakes what sleeps within two cells of a shape.</summary>
        public void Wake(Shape shape)
        {
            Done(Methods.pbmpm_world_wake(Id, &shape));
        }
    }
}
