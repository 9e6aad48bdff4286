using Unity.Collections;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>What renderers of particles share: the particles on the GPU, drawn between the last two states, and a material.</summary>
    public abstract class PbmpmRenderer : MonoBehaviour
    {
        const float AllMatter = -1;

        static readonly int ParticlesName = Shader.PropertyToID("_PbmpmParticles");
        static readonly int OriginName = Shader.PropertyToID("_PbmpmOrigin");
        static readonly int RadiusName = Shader.PropertyToID("_PbmpmRadius");
        static readonly int OnlyName = Shader.PropertyToID("_PbmpmOnly");
        static readonly int ColoursName = Shader.PropertyToID("_PbmpmColours");

        [Tooltip("None: the one above it, or else the first of the scene.")]
        public PbmpmWorld world;

        [Tooltip("Of a particle [m]; 0: fits the world's cells.")]
        public float radius;

        [Tooltip("What it draws. None: all matter.")]
        public PbmpmMaterial only;

        NativeArray<ParticleRecord> records;
        ComputeBuffer buffer;
        Material material;
        int painted = -1;
        PbmpmWorld source;

        /// <summary>Particles that are drawn.</summary>
        public int Count { get; private set; }

        protected Material Material => material;
        /// <summary>Its file, in Resources.</summary>
        protected abstract string ShaderName { get; }

        /// <summary>Of a particle, as a share of a cell.</summary>
        protected abstract float RadiusInCells { get; }

        /// <summary>The world whose particles it draws; null without one.</summary>
        protected PbmpmWorld Source => source;

        protected virtual void OnEnable()
        {
            var shader = Resources.Load<Shader>("Pbmpm/" + ShaderName); // so that builds have it
            if (shader == null)
            {
                Debug.LogError("pbmpm: the package lacks the shader '" + ShaderName + "'", this);
                enabled = false;
                return;
            }
            material = new Material(shader) { hideFlags = HideFlags.HideAndDontSave };
        }

        protected virtual void OnDisable()
        {
            Release();
            if (material != null) Destroy(material);
            material = null;
        }

        /// <summary>Takes the particles over. False when there is nothing to draw.</summary>
        protected bool Upload()
        {
            var now = world != null ? world : Nearest();
            if (now != source) Release();
            source = now;
            if (source == null || !source.IsOpen || material == null) return false;
            Hold(source.capacity);
            Count = source.Copy(records);
            if (Count == 0) return false;
            buffer.SetData(records, 0, 0, Count);
            Describe();
            return true;
        }

        PbmpmWorld Nearest()
        {
            if (source != null) return source;
            var above = GetComponentInParent<PbmpmWorld>();
            return above != null ? above : PbmpmWorld.First;
        }

        unsafe void Hold(int capacity)
        {
            if (buffer != null && records.Length == capacity) return;
            Release();
            records = new NativeArray<ParticleRecord>(capacity, Allocator.Persistent, NativeArrayOptions.UninitializedMemory);
            buffer = new ComputeBuffer(capacity, sizeof(ParticleRecord));
        }

        void Describe()
        {
            material.SetBuffer(ParticlesName, buffer);
            material.SetVector(OriginName, source.Outward(Vector3.zero));
            material.SetFloat(RadiusName, radius > 0 ? radius : RadiusInCells * source.cellSize);
            material.SetFloat(OnlyName, only != null ? source.Colours.IndexOf(only) : AllMatter);
            if (painted == source.Colours.Revision) return;
            material.SetVectorArray(ColoursName, source.Colours.Colours);
            painted = source.Colours.Revision;
        }

        void Release()
        {
            if (buffer != null) buffer.Release();
            if (records.IsCreated) records.Dispose();
            buffer = null;
            records = default(NativeArray<ParticleRecord>);
            painted = -1;
            Count = 0;
        }
    }
}
