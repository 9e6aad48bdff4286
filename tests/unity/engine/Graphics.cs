using System;
using System.Collections.Generic;
using Unity.Collections;
using UnityEngine.Rendering;

// What is sent to the GPU is counted, and goes nowhere.
namespace UnityEngine
{
    public enum MeshTopology
    {
        Triangles = 0,
    }

    public enum FilterMode
    {
        Point = 0,
    }

    public enum RenderTextureFormat
    {
        RFloat = 14,
        RHalf = 15,
    }

    [Flags]
    public enum DepthTextureMode
    {
        None = 0,
        Depth = 1,
    }

    public sealed class Mesh : Object
    {
        public Vector3[] vertices { get; set; } = new Vector3[0];
        public int[] triangles { get; set; } = new int[0];
    }

    public sealed class Shader : Object
    {
        static readonly Dictionary<string, int> Names = new Dictionary<string, int>();

        public static int PropertyToID(string name)
        {
            int id;
            if (!Names.TryGetValue(name, out id)) Names.Add(name, id = Names.Count + 1);
            return id;
        }
    }

    public class Material : Object
    {
        public Material(Shader shader)
        {
            if (shader == null) throw new ArgumentNullException(nameof(shader));
        }

        public void SetBuffer(int nameID, ComputeBuffer value)
        {
        }

        public void SetVector(int nameID, Vector4 value)
        {
        }

        public void SetFloat(int nameID, float value)
        {
        }

        public void SetMatrix(int nameID, Matrix4x4 value)
        {
        }

        public void SetVectorArray(int nameID, Vector4[] values)
        {
        }
    }

    public sealed class MaterialPropertyBlock
    {
    }

    public sealed class ComputeBuffer : IDisposable
    {
        /// <summary>Not part of Unity.</summary>
        public static int Alive;

        public ComputeBuffer(int count, int stride)
        {
            this.count = count;
            Alive++;
        }

        public int count { get; }

        public void SetData<T>(NativeArray<T> data, int nativeBufferStartIndex, int computeBufferStartIndex, int count) where T : struct
        {
            if (count > this.count || count > data.Length) throw new ArgumentOutOfRangeException(nameof(count));
        }

        public void Release()
        {
            Alive--;
        }

        public void Dispose()
        {
            Release();
        }
    }

    public sealed class Light : Behaviour
    {
    }

    public sealed class Camera : Behaviour
    {
        public delegate void CameraCallback(Camera cam);

        static readonly List<Camera> All = new List<Camera>();
        public static CameraCallback onPostRender;

        public Camera()
        {
            All.Add(this);
        }

        public int cullingMask { get; set; } = -1;
        public int pixelWidth => 640;
        public int pixelHeight => 480;
        public DepthTextureMode depthTextureMode { get; set; }
        public Matrix4x4 projectionMatrix => Matrix4x4.identity;
        public Matrix4x4 worldToCameraMatrix => Matrix4x4.identity;
        public static Camera main => All.Count > 0 ? All[0] : null;

        public Ray ScreenPointToRay(Vector3 pos)
        {
            return new Ray { origin = transform.position, direction = transform.forward };
        }

        internal override void End()
        {
            All.Remove(this);
            base.End();
        }

        internal static void Render()
        {
            for (var i = 0; i < All.Count; i++)
            {
                if (GraphicsSettings.currentRenderPipeline == null && onPostRender != null) onPostRender(All[i]);
                RenderPipelineManager.Render(All[i]);
            }
        }
    }

    public static class GL
    {
        public static Matrix4x4 GetGPUProjectionMatrix(Matrix4x4 proj, bool renderIntoTexture)
        {
            return proj;
        }
    }

    public static class Graphics
    {
        /// <summary>Instances drawn in all. Not part of Unity.</summary>
        public static long Drawn;

        public static void DrawProcedural(Material material, Bounds bounds, MeshTopology topology, int vertexCount, int instanceCount = 1, Camera camera = null,
                                          MaterialPropertyBlock properties = null, ShadowCastingMode castShadows = ShadowCastingMode.On,
                                          bool receiveShadows = true, int layer = 0)
        {
            Drawn += instanceCount;
        }

        public static void ExecuteCommandBuffer(CommandBuffer buffer)
        {
            Drawn += buffer.Instances;
        }
    }

    public sealed class Gizmos
    {
        public static Color color { get; set; }
        public static Matrix4x4 matrix { get; set; }

        public static void DrawWireCube(Vector3 center, Vector3 size)
        {
        }

        public static void DrawWireSphere(Vector3 center, float radius)
        {
        }

        public static void DrawLine(Vector3 from, Vector3 to)
        {
        }
    }

    public enum EventType
    {
        Repaint = 7,
        Layout = 8,
    }

    public sealed class Event
    {
        public static Event current { get; } = new Event();
        public EventType type => EventType.Repaint;
    }

    public class GUI
    {
        /// <summary>What labels showed, if it is set. Not part of Unity.</summary>
        public static List<string> Shown;

        public static void Label(Rect position, string text)
        {
            if (Shown != null) Shown.Add(text);
        }
    }

    public class GUILayout
    {
        public static bool Button(string text)
        {
            return false;
        }
    }
}

namespace UnityEngine.Rendering
{
    public enum ShadowCastingMode
    {
        Off = 0,
        On = 1,
    }

    public enum BuiltinRenderTextureType
    {
        CameraTarget = 2,
    }

    public struct RenderTargetIdentifier
    {
        public static implicit operator RenderTargetIdentifier(int nameID) => default(RenderTargetIdentifier);
        public static implicit operator RenderTargetIdentifier(BuiltinRenderTextureType type) => default(RenderTargetIdentifier);
    }

    public class CommandBuffer : IDisposable
    {
        internal long Instances;
        public string name { get; set; }

        public void Clear()
        {
            Instances = 0;
        }

        public void GetTemporaryRT(int nameID, int width, int height, int depthBuffer, FilterMode filter, RenderTextureFormat format)
        {
        }

        public void ReleaseTemporaryRT(int nameID)
        {
        }

        public void SetRenderTarget(RenderTargetIdentifier rt)
        {
        }

        public void ClearRenderTarget(bool clearDepth, bool clearColor, Color backgroundColor)
        {
        }

        public void SetGlobalTexture(int nameID, RenderTargetIdentifier value)
        {
        }

        public void SetGlobalVector(int nameID, Vector4 value)
        {
        }

        public void DrawProcedural(Matrix4x4 matrix, Material material, int shaderPass, MeshTopology topology, int vertexCount, int instanceCount)
        {
            Instances += instanceCount;
        }

        public void Release()
        {
        }

        public void Dispose()
        {
        }
    }

    public struct ScriptableRenderContext
    {
        public void ExecuteCommandBuffer(CommandBuffer commandBuffer)
        {
            Graphics.ExecuteCommandBuffer(commandBuffer);
        }

        public void Submit()
        {
        }
    }

    public abstract class RenderPipelineAsset : ScriptableObject
    {
    }

    public sealed class GraphicsSettings
    {
        public static RenderPipelineAsset currentRenderPipeline { get; set; }
    }

    public static class RenderPipelineManager
    {
        public static event Action<ScriptableRenderContext, Camera> endCameraRendering;

        internal static void Render(Camera camera)
        {
            if (GraphicsSettings.currentRenderPipeline != null && endCameraRendering != null)
                endCameraRendering(default(ScriptableRenderContext), camera);
        }
    }
}

namespace Unity.Profiling
{
    public struct ProfilerMarker
    {
        public ProfilerMarker(string name)
        {
        }

        public void Begin()
        {
        }

        public void End()
        {
        }
    }
}
