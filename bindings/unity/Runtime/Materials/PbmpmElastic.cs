using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Keeps its shape: jelly, rubber.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Elastic", fileName = "Elastic")]
    public sealed class PbmpmElastic : PbmpmStiffMaterial
    {
        [Tooltip("How stress follows from strain. Neo-Hookean stiffens as it is crushed; the paper's and the dual solver take the other.")]
        public ElasticModel model = ElasticModel.FixedCorotated;

        protected override void DescribeFlow(ref MaterialDef definition)
        {
            definition.Kind = MaterialKind.Elastic;
            definition.ElasticModel = model;
        }
    }
}
