using Pbmpm.Components;
using UnityEditor;
using UnityEngine;

namespace Pbmpm.Editing
{
    /// <summary>Shows what a material's stiffness comes to in the worlds of the open scenes: few iterations make it softer.</summary>
    [CustomEditor(typeof(PbmpmMaterial), true)]
    public sealed class PbmpmMaterialEditor : Editor
    {
        string answer = "";

        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            EditorGUILayout.Space();
            if (GUILayout.Button("What acts in this scene")) answer = Ask((PbmpmMaterial)target);
            if (answer.Length > 0) EditorGUILayout.HelpBox(answer, MessageType.Info);
        }

        internal static string Ask(PbmpmMaterial material)
        {
            var answer = "";
            foreach (var world in SceneTrial.All<PbmpmWorld>())
            {
                var trial = SceneTrial.Of(world);
                Effective acting;
                if (trial.Problem.Length > 0) answer += world.name + ": " + trial.Problem + "\n";
                else if (trial.Acting.TryGetValue(material, out acting)) answer += world.name + ": " + SceneTrial.Describe(acting) + "\n";
            }
            return answer.Length > 0 ? answer.TrimEnd() : "No world of the scene has this material.";
        }
    }
}
