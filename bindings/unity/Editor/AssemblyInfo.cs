using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Pbmpm.Tests.Editor")]
