using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Flows where it is strained too far: clay, dough, mud.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Visco", fileName = "Visco")]
    public sealed class PbmpmVisco : PbmpmStiffMaterial
    {
        [Tooltip("Strain that it bears, 0 to 10.")]
        public float yieldStrain = 0.05f;

        [Tooltip("How fast strain beyond that goes [1/s], 0 to 1e9.")]
        public float flowRate = 100;

        protected override void DescribeFlow(ref MaterialDef definition)
        {
            definition.Kind = MaterialKind.Visco;
            definition.YieldStrain = yieldStrain;
            definition.FlowRate = flowRate;
        }
    }
}
