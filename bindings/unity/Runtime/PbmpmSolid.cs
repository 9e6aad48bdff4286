using System;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>A mesh or a terrain as a grid of distances, which any number of parts share. Bake it in its inspector, or by
    /// <see cref="Bake"/>. A transform moves and turns it, and does not scale it: set <see cref="scale"/>, and bake again.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Baked solid", fileName = "Solid")]
    public sealed class PbmpmSolid : ScriptableObject
    {
        [Tooltip("A closed mesh that may be read (Read/Write in its import settings).")]
        public Mesh mesh;

        [Tooltip("In place of a mesh: the heights of a terrain, solid below.")]
        public TerrainData terrain;

        [Tooltip("Of the mesh.")]
        public Vector3 scale = new Vector3(1, 1, 1);

        [Tooltip("Grid cells along the longest side, 4 to 1024. Terrain: 0 takes that of its heights.")]
        public int resolution = 64;

        [Tooltip("Terrain: how far its base lies below the lowest point [m].")]
        public float thickness = 1;

        [SerializeField, HideInInspector] byte[] data = new byte[0];
        [SerializeField, HideInInspector] Vector3 middle;
        [SerializeField, HideInInspector] Vector3 extent;

        [NonSerialized] BakedSolid read;

        /// <summary>Whether worlds can load it.</summary>
        public bool IsBaked => data.Length > 0;

        /// <summary>Middle of the box around it [m].</summary>
        public Vector3 Middle => middle;

        /// <summary>Edges of the box around it [m].</summary>
        public Vector3 Size => extent;

        /// <summary>Bytes that it takes, stored or loaded.</summary>
        public int Bytes => data.Length;

        /// <summary>What a world loads.</summary>
        /// <exception cref="InvalidOperationException">It was not baked.</exception>
        internal BakedSolid Baked
        {
            get
            {
                if (!IsBaked) throw new InvalidOperationException("pbmpm: the solid '" + name + "' was not baked yet; bake it in its inspector");
                return read ?? (read = new BakedSolid(data));
            }
        }

        /// <summary>Bakes at once, which takes up to some seconds.</summary>
        public void Bake()
        {
            Keep(Prepare()());
        }

        /// <summary>Reads mesh or terrain, which only the main thread may. The work that is left runs on any thread.</summary>
        internal Func<BakedSolid> Prepare()
        {
            if (terrain != null) return PrepareTerrain();
            if (mesh == null) throw new InvalidOperationException("pbmpm: the solid '" + name + "' has neither a mesh nor a terrain");
            return PrepareMesh();
        }

        internal void Keep(BakedSolid baked)
        {
            data = baked.Data;
            Vector3 low = baked.Info.Minimum, high = baked.Info.Maximum;
            middle = (low + high) * 0.5f;
            extent = high - low;
            read = null;
        }

        Func<BakedSolid> PrepareMesh()
        {
            var corners = mesh.vertices;
            var triangles = mesh.triangles;
            var vertices = new float[corners.Length * 3];
            for (var i = 0; i < vertices.Length; i++) vertices[i] = corners[i / 3][i % 3] * scale[i % 3];
            var elements = new uint[triangles.Length];
            for (var i = 0; i < elements.Length; i++) elements[i] = (uint)triangles[i];
            var cells = resolution;
            return () => BakedSolid.FromMesh(3, vertices, elements, cells);
        }

        Func<BakedSolid> PrepareTerrain()
        {
            var samples = terrain.heightmapResolution;
            var size = terrain.size;
            var rows = terrain.GetHeights(0, 0, samples, samples); // [z, x], as shares of the height
            var heights = new float[samples * samples];
            for (var i = 0; i < heights.Length; i++) heights[i] = rows[i / samples, i % samples] * size.y;
            var spacing = new Float2(size.x / (samples - 1), size.z / (samples - 1));
            var count = new Uint2((uint)samples, (uint)samples);
            int cells = resolution;
            float depth = thickness;
            return () => BakedSolid.FromHeights(3, heights, count, spacing, 1, depth, cells);
        }
    }
}
