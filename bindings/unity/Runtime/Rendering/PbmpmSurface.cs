using UnityEngine;
using UnityEngine.Rendering;

namespace Pbmpm.Components
{
    /// <summary>Draws liquid as a surface, in screen space: depths of balls, smoothed, become normals; their thickness becomes the tint.
    /// It works with the built-in and the universal pipeline. Cameras need a depth texture (universal: set it in the pipeline's asset).</summary>
    [AddComponentMenu("pbmpm/Surface renderer")]
    public sealed class PbmpmSurface : PbmpmRenderer
    {
        const int DepthPass = 0, ThicknessPass = 1, SmoothPass = 2, ComposePass = 3;
        const float Far = 1e6f; // [m], where there is no liquid

        static readonly int View = Shader.PropertyToID("_PbmpmView"), Projection = Shader.PropertyToID("_PbmpmProjection");
        static readonly int Unprojection = Shader.PropertyToID("_PbmpmUnprojection"), Depths = Shader.PropertyToID("_PbmpmDepths");
        static readonly int Thickness = Shader.PropertyToID("_PbmpmThickness"), Smoothed = Shader.PropertyToID("_PbmpmSmoothed");
        static readonly int Read = Shader.PropertyToID("_PbmpmSource"), Axis = Shader.PropertyToID("_PbmpmAxis");
        static readonly int Tint = Shader.PropertyToID("_PbmpmTint"), Light = Shader.PropertyToID("_PbmpmLight");
        static readonly int Clarity = Shader.PropertyToID("_PbmpmClarity"), Flip = Shader.PropertyToID("_PbmpmFlip");

        [Tooltip("Colour of deep liquid.")]
        public Color tint = new Color(0.1f, 0.35f, 0.5f);

        [Tooltip("Depth of liquid through which a third of the light comes [m].")]
        public float clarity = 0.5f;

        [Tooltip("Rounds of smoothing, 0 to 8.")]
        public int smoothing = 2;

        [Tooltip("Where light comes from. None: from above.")]
        public Light sun;

        [Tooltip("For platforms that show it upside down.")]
        public bool flip;

        CommandBuffer commands;
        bool drawn;

        protected override string ShaderName => "PbmpmSurface";
        protected override float RadiusInCells => 0.6f;

        protected override void OnEnable()
        {
            base.OnEnable();
            commands = new CommandBuffer { name = "pbmpm surface" };
            Camera.onPostRender += AfterBuiltIn;
            RenderPipelineManager.endCameraRendering += AfterScriptable;
        }

        protected override void OnDisable()
        {
            Camera.onPostRender -= AfterBuiltIn;
            RenderPipelineManager.endCameraRendering -= AfterScriptable;
            if (commands != null) commands.Release();
            commands = null;
            base.OnDisable();
        }

        void LateUpdate()
        {
            drawn = Upload();
        }

        void AfterBuiltIn(Camera camera)
        {
            if (GraphicsSettings.currentRenderPipeline != null || !Shows(camera)) return;
            camera.depthTextureMode |= DepthTextureMode.Depth;
            Record(camera);
            Graphics.ExecuteCommandBuffer(commands);
        }

        void AfterScriptable(ScriptableRenderContext context, Camera camera)
        {
            if (!Shows(camera)) return;
            Record(camera);
            context.ExecuteCommandBuffer(commands);
            context.Submit();
        }

        bool Shows(Camera camera)
        {
            return drawn && Material != null && (camera.cullingMask & 1 << gameObject.layer) != 0;
        }

        void Record(Camera camera)
        {
            Describe(camera);
            commands.Clear();
            Splat(Depths, RenderTextureFormat.RFloat, DepthPass, camera, Far);
            Splat(Thickness, RenderTextureFormat.RHalf, ThicknessPass, camera, 0);
            commands.GetTemporaryRT(Smoothed, camera.pixelWidth, camera.pixelHeight, 0, FilterMode.Point, RenderTextureFormat.RFloat);
            for (var round = 0; round < Mathf.Clamp(smoothing, 0, 8); round++)
            {
                Filter(Depths, Smoothed, new Vector4(1, 0, 0, 0));
                Filter(Smoothed, Depths, new Vector4(0, 1, 0, 0));
            }
            commands.SetRenderTarget(BuiltinRenderTextureType.CameraTarget);
            Fullscreen(ComposePass);
            commands.ReleaseTemporaryRT(Depths);
            commands.ReleaseTemporaryRT(Thickness);
            commands.ReleaseTemporaryRT(Smoothed);
        }

        void Describe(Camera camera)
        {
            var projection = GL.GetGPUProjectionMatrix(camera.projectionMatrix, true);
            Material.SetMatrix(View, camera.worldToCameraMatrix);
            Material.SetMatrix(Projection, projection);
            Material.SetMatrix(Unprojection, projection.inverse);
            Material.SetVector(Tint, tint);
            Material.SetFloat(Clarity, Mathf.Max(1e-3f, clarity));
            Material.SetFloat(Flip, flip ? 1 : 0);
            var light = sun != null ? -sun.transform.forward : Vector3.up;
            Material.SetVector(Light, camera.worldToCameraMatrix.MultiplyVector(light));
        }

        void Splat(int target, RenderTextureFormat format, int pass, Camera camera, float empty)
        {
            commands.GetTemporaryRT(target, camera.pixelWidth, camera.pixelHeight, 0, FilterMode.Point, format);
            commands.SetRenderTarget(target);
            commands.ClearRenderTarget(false, true, new Color(empty, 0, 0, 0));
            commands.DrawProcedural(Matrix4x4.identity, Material, pass, MeshTopology.Triangles, 6, Count);
        }

        void Filter(int from, int to, Vector4 axis)
        {
            commands.SetGlobalTexture(Read, from);
            commands.SetGlobalVector(Axis, axis);
            commands.SetRenderTarget(to);
            Fullscreen(SmoothPass);
        }

        void Fullscreen(int pass)
        {
            commands.DrawProcedural(Matrix4x4.identity, Material, pass, MeshTopology.Triangles, 3, 1);
        }
    }
}
