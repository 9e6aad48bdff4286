using UnityEngine;
using UnityEngine.Rendering;

namespace Pbmpm.Components
{
    /// <summary>Draws each particle as a small ball, in the colour of its material: one instanced draw, in any pipeline.</summary>
    [AddComponentMenu("pbmpm/Points renderer")]
    public sealed class PbmpmPoints : PbmpmRenderer
    {
        static readonly int LightName = Shader.PropertyToID("_PbmpmLight");

        [Tooltip("Where light comes from. None: from above.")]
        public Light sun;

        protected override string ShaderName => "PbmpmPoints";
        protected override float RadiusInCells => 0.25f;

        void LateUpdate()
        {
            if (!Upload()) return;
            var light = sun != null ? -sun.transform.forward : Vector3.up;
            Material.SetVector(LightName, light);
            // Two triangles a particle. Matter may leave the box where there are no walls, so nothing is culled by it
            var bounds = new Bounds(Source.Outward(Vector3.zero), Vector3.one * 1e6f);
            Graphics.DrawProcedural(Material, bounds, MeshTopology.Triangles, 6, Count, null, null, ShadowCastingMode.Off, false, gameObject.layer);
        }
    }
}
