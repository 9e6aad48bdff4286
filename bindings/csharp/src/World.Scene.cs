using System;
using Pbmpm.Native;

namespace Pbmpm
{
    // What is in the world, the box that it is in, and lines that show both
    public sealed unsafe partial class World
    {
        // The domain

        /// <summary>The wall at the lower or upper end of an axis.</summary>
        public DomainWall GetWall(int axis, bool upper)
        {
            var found = new DomainWall { Size = (uint)sizeof(DomainWall) };
            Done(Methods.pbmpm_domain_wall_get(Id, axis, upper ? 1 : 0, &found));
            return found;
        }

        /// <summary>Changes a wall, as read by <see cref="GetWall"/>. Matter that is outside when one closes is put back to it.</summary>
        public void SetWall(int axis, bool upper, DomainWall wall)
        {
            Done(Methods.pbmpm_domain_wall_set(Id, axis, upper ? 1 : 0, &wall));
        }

        /// <summary>Moves the origin that all positions are relative to by the multiple of 4 cells that is nearest to
        /// <paramref name="wanted"/> [m]. Returns what that was: all positions are now less by it.</summary>
        public Double3 ShiftOrigin(Double3 wanted)
        {
            Double3 moved;
            Changed(Methods.pbmpm_world_shift_origin(Id, &wanted, &moved));
            return moved;
        }

        // Touches

        /// <summary>Which materials touch the colliders that report touches, and where that has begun or ended since the call
        /// before. Writes as many as there is room for and returns the full number; with less room the next call compares with
        /// the same.</summary>
        public int Touches(Touch[] touches)
        {
            if (touches == null) throw new ArgumentNullException(nameof(touches));
            uint count;
            if (touches.Length > 0) touches[0].Size = (uint)sizeof(Touch);
            fixed (Touch* first = touches) Done(Methods.pbmpm_world_touches(Id, first, (uint)touches.Length, &count));
            return (int)count;
        }

        // Lines

        /// <summary>How many lines show these parts.</summary>
        public int CountDebugLines(DebugPart parts = DebugPart.All)
        {
            uint count;
            Done(Methods.pbmpm_world_debug_lines(Id, (uint)parts, null, 0, &count));
            return (int)count;
        }

        /// <summary>Lines that show obstacles, regions and the grid, as many as there is room for. Returns how many there are.</summary>
        public int DebugLines(Line[] lines, DebugPart parts = DebugPart.All)
        {
            if (lines == null) throw new ArgumentNullException(nameof(lines));
            uint count;
            fixed (Line* first = lines) Done(Methods.pbmpm_world_debug_lines(Id, (uint)parts, first, (uint)lines.Length, &count));
            return (int)count;
        }

        // Lists. Each makes an array.

        /// <summary>Whether the identifier is that of a material of this world.</summary>
        public bool IsValid(MaterialId material)
        {
            int valid;
            Done(Methods.pbmpm_material_is_valid(Id, material, &valid));
            return valid != 0;
        }

        /// <summary>All materials of the world.</summary>
        public MaterialId[] GetMaterials()
        {
            uint count;
            Done(Methods.pbmpm_world_get_materials(Id, null, 0, &count));
            var found = new MaterialId[count];
            fixed (MaterialId* first = found) Done(Methods.pbmpm_world_get_materials(Id, first, count, &count));
            return found;
        }

        /// <summary>Whether the identifier is that of a collider of this world.</summary>
        public bool IsValid(ColliderId collider)
        {
            int valid;
            Done(Methods.pbmpm_collider_is_valid(Id, collider, &valid));
            return valid != 0;
        }

        /// <summary>All colliders of the world.</summary>
        public ColliderId[] GetColliders()
        {
            uint count;
            Done(Methods.pbmpm_world_get_colliders(Id, null, 0, &count));
            var found = new ColliderId[count];
            fixed (ColliderId* first = found) Done(Methods.pbmpm_world_get_colliders(Id, first, count, &count));
            return found;
        }

        /// <summary>Whether the identifier is that of an emitter of this world.</summary>
        public bool IsValid(EmitterId emitter)
        {
            int valid;
            Done(Methods.pbmpm_emitter_is_valid(Id, emitter, &valid));
            return valid != 0;
        }

        /// <summary>All emitters of the world.</summary>
        public EmitterId[] GetEmitters()
        {
            uint count;
            Done(Methods.pbmpm_world_get_emitters(Id, null, 0, &count));
            var found = new EmitterId[count];
            fixed (EmitterId* first = found) Done(Methods.pbmpm_world_get_emitters(Id, first, count, &count));
            return found;
        }

        /// <summary>Whether the identifier is that of a drain of this world.</summary>
        public bool IsValid(DrainId drain)
        {
            int valid;
            Done(Methods.pbmpm_drain_is_valid(Id, drain, &valid));
            return valid != 0;
        }

        /// <summary>All drains of the world.</summary>
        public DrainId[] GetDrains()
        {
            uint count;
            Done(Methods.pbmpm_world_get_drains(Id, null, 0, &count));
            var found = new DrainId[count];
            fixed (DrainId* first = found) Done(Methods.pbmpm_world_get_drains(Id, first, count, &count));
            return found;
        }

        /// <summary>Whether the identifier is that of a force of this world.</summary>
        public bool IsValid(ForceId force)
        {
            int valid;
            Done(Methods.pbmpm_force_is_valid(Id, force, &valid));
            return valid != 0;
        }

        /// <summary>All forces of the world.</summary>
        public ForceId[] GetForces()
        {
            uint count;
            Done(Methods.pbmpm_world_get_forces(Id, null, 0, &count));
            var found = new ForceId[count];
            fixed (ForceId* first = found) Done(Methods.pbmpm_world_get_forces(Id, first, count, &count));
            return found;
        }
    }
}
