using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>What matter is made of. Changes take effect with the next step; call <see cref="Change"/> after one by a script. Kind and
    /// density stay as they were when a world took the material in.</summary>
    public abstract class PbmpmMaterial : ScriptableObject
    {
        [Tooltip("Rest density [kg/m^3], 1e-3 to 1e6.")]
        public float density = 1000;

        [Tooltip("Bit by bit, the groups that it belongs to. Colliders choose whom they meet by them.")]
        public int groups = 1;

        [Tooltip("How it is drawn.")]
        public Color color = Color.white;

        /// <summary>Counts changes.</summary>
        internal int Revision { get; private set; }

        /// <summary>Tells worlds that something was changed.</summary>
        public void Change()
        {
            Revision++;
        }

        /// <summary>As the library takes it.</summary>
        public MaterialDef Definition()
        {
            var definition = MaterialDef.Default;
            definition.Density = density;
            definition.Groups = (uint)groups;
            Describe(ref definition);
            return definition;
        }

        protected abstract void Describe(ref MaterialDef definition);

        protected void OnValidate()
        {
            Change();
        }
    }

    /// <summary>What all solids have.</summary>
    public abstract class PbmpmStiffMaterial : PbmpmMaterial
    {
        [Tooltip("Young's modulus [Pa], 1e-3 to 1e15. The inspector of a world tells what acts.")]
        public float youngModulus = 1e5f;

        [Tooltip("0 to 0.495.")]
        public float poissonRatio = 0.3f;

        protected sealed override void Describe(ref MaterialDef definition)
        {
            definition.YoungModulus = youngModulus;
            definition.PoissonRatio = poissonRatio;
            DescribeFlow(ref definition);
        }

        protected abstract void DescribeFlow(ref MaterialDef definition);
    }
}
