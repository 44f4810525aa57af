"""The EDS of a device with few objects and very many sub-indices, for sizes that no specification can have.

A specification has at most 32,768 objects below 2000h to 9FFFh. Here objects are records of 250 members, whose sections make up
nearly all of the file: of every five members one is read only, one has limits, one a mapping.
"""

from __future__ import annotations

from collections.abc import Iterator

MEMBERS = 250
FIRST = 0x2000

HEAD = """\
[FileInfo]
FileName={name}
FileVersion=1
FileRevision=0
EDSVersion=4.0
Description=Measures how fast a reader is
CreationTime=12:00PM
CreationDate=01-31-2024
CreatedBy=Example Works
ModificationTime=12:00PM
ModificationDate=01-31-2024
ModifiedBy=Example Works

[DeviceInfo]
VendorName=Example Works
VendorNumber=0x123
ProductName=Wide
ProductNumber=0x1
RevisionNumber=0
OrderCode=W{entries}
BaudRate_10=0
BaudRate_20=0
BaudRate_50=0
BaudRate_125=1
BaudRate_250=1
BaudRate_500=1
BaudRate_800=0
BaudRate_1000=0
SimpleBootUpMaster=0
SimpleBootUpSlave=1
Granularity=8
DynamicChannelsSupported=0
GroupMessaging=0
NrOfRXPDO=0
NrOfTXPDO=0
LSS_Supported=0

[DummyUsage]
Dummy0001=0
Dummy0002=0
Dummy0003=0
Dummy0004=0
Dummy0005=0
Dummy0006=0
Dummy0007=0

[Comments]
Lines=0

[MandatoryObjects]
SupportedObjects=3
1=0x1000
2=0x1001
3=0x1018

[1000]
ParameterName=Device type
ObjectType=0x7
DataType=0x0007
AccessType=ro
DefaultValue=0x00000000
PDOMapping=0

[1001]
ParameterName=Error register
ObjectType=0x7
DataType=0x0005
AccessType=ro
PDOMapping=0

[1018]
ParameterName=Identity object
ObjectType=0x9
SubNumber=2

[1018sub0]
ParameterName=Highest sub-index supported
ObjectType=0x7
DataType=0x0005
AccessType=const
DefaultValue=1
PDOMapping=0

[1018sub1]
ParameterName=Vendor-ID
ObjectType=0x7
DataType=0x0007
AccessType=ro
DefaultValue=0x00000123
PDOMapping=0

[OptionalObjects]
SupportedObjects=1
1=0x1017

[1017]
ParameterName=Producer heartbeat time
ObjectType=0x7
DataType=0x0006
AccessType=rw
DefaultValue=1000
PDOMapping=0

"""

RECORD = """\
[{index:04X}]
ParameterName=Group {number}
ObjectType=0x9
SubNumber={count}

[{index:04X}sub0]
ParameterName=Highest sub-index supported
ObjectType=0x7
DataType=0x0005
AccessType=const
DefaultValue={members}
PDOMapping=0

"""

SHAPES = (
    "DataType=0x0006\nAccessType=rw\nDefaultValue={value}\nPDOMapping=0\n",
    "DataType=0x0003\nLowLimit=-{value}\nHighLimit={value}\nAccessType=rw\nDefaultValue=0\nPDOMapping=0\n",
    "DataType=0x0007\nAccessType=ro\nPDOMapping=0\n",
    "DataType=0x0004\nAccessType=rw\nDefaultValue=-{value}\nPDOMapping=0\n",
    "DataType=0x0007\nAccessType=rw\nDefaultValue=0x{value:08X}\nPDOMapping=0\n",
)


def eds(entries: int, name: str) -> str:
    """A file of this name with so many members, a multiple of 250."""
    objects, rest = divmod(entries, MEMBERS)
    if rest or not objects:
        raise ValueError(f"{entries} is no multiple of {MEMBERS}")
    return "".join((HEAD.format(name=name, entries=entries), *listed(objects), *described(objects))).replace("\n", "\r\n")


def listed(objects: int) -> Iterator[str]:
    yield f"[ManufacturerObjects]\nSupportedObjects={objects}\n"
    for number in range(objects):
        yield f"{number + 1}=0x{FIRST + number:04X}\n"
    yield "\n"


def described(objects: int) -> Iterator[str]:
    for number in range(objects):
        index = FIRST + number
        yield RECORD.format(index=index, number=number, count=MEMBERS + 1, members=MEMBERS)
        for sub in range(1, MEMBERS + 1):
            shape = SHAPES[sub % len(SHAPES)].format(value=number * 100 % 30000 + sub)
            yield f"[{index:04X}sub{sub:X}]\nParameterName=Value {number}.{sub}\nObjectType=0x7\n{shape}\n"
