using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Keeps its shape: jelly, rubber.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Elastic", fileName = "Elastic")]
    public sealed class PbmpmElastic : PbmpmStiffMaterial
    {
        public ElasticModel model = ElasticModel.FixedCorotated;

        protected override void DescribeFlow(ref MaterialDef definition)
        {
            definition.Kind = MaterialKind.Elastic;
            definition.ElasticModel = model;
        }
    }
}
